# SPDX-License-Identifier: Apache-2.0
"""How good are a trajectory and its map, without ground truth?

    import trysquare as ts

    scans, poses = ts.load("sequences/00", first=0, last=19)
    result = ts.evaluate(scans, poses, min_range_m=2.8)
    print(result.mom.value, result.rpe_estimate.translation_rms_m, result.rpe_estimate.interval_m)

Points are (N, 3) arrays [m], poses (M, 4, 4) arrays `world_from_scan`, angles degrees. What has no value is None or NaN
with the reason beside it, never 0. Source: Kornilova & Ferrer, "Be your own Benchmark", 2021; docs/definitions.md.
"""

from trysquare._compare import compare
from trysquare._comparison import Comparison
from trysquare._core import Error, InvalidArgument, IoError, __version__
from trysquare._dataset import Dataset, TrysquareWarning, load, open_dataset
from trysquare._diagnose import diagnose
from trysquare._diagnosis import Diagnosis
from trysquare._evaluate import evaluate, evaluate_map
from trysquare._evaluation import Evaluation, RpeEstimate
from trysquare._io import (
    Trajectory,
    read_calibration,
    read_extrinsic,
    read_points,
    read_scan,
    read_trajectory,
    write_trajectory,
)
from trysquare._metrics import OrthogonalMetric, PointMetric, mme, mom, mpv, omme
from trysquare._orthogonal import OrthogonalSubset, extract_orthogonal_subset
from trysquare._refine import Refinement, refine
from trysquare._settings import default_settings
from trysquare._trajectory import TrajectoryErrors, ape, perturb, rpe

__all__ = [
    "Comparison",
    "Dataset",
    "Diagnosis",
    "Error",
    "Evaluation",
    "InvalidArgument",
    "IoError",
    "OrthogonalMetric",
    "OrthogonalSubset",
    "PointMetric",
    "Refinement",
    "RpeEstimate",
    "Trajectory",
    "TrajectoryErrors",
    "TrysquareWarning",
    "__version__",
    "ape",
    "compare",
    "default_settings",
    "diagnose",
    "evaluate",
    "evaluate_map",
    "extract_orthogonal_subset",
    "load",
    "mme",
    "mom",
    "mpv",
    "omme",
    "open_dataset",
    "perturb",
    "read_calibration",
    "read_extrinsic",
    "read_points",
    "read_scan",
    "read_trajectory",
    "refine",
    "rpe",
    "write_trajectory",
]
