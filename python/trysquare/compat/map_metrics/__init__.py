# SPDX-License-Identifier: Apache-2.0
"""Drop-in for the package map-metrics 0.0.4: its calls, its definitions, its numbers; not its code.

    from trysquare.compat import map_metrics
    from trysquare.compat.map_metrics.config import LidarConfig
    from trysquare.compat.map_metrics.metrics import mme, mom, mpv

Point clouds may be Open3D's, old (`.points`) or new (`.point.positions`), or numpy arrays; Open3D is not needed.

What differs from the original, on purpose:

- Nothing to average gives NaN and a `TrysquareWarning` with the reason. The original gives 0.0, a perfect score.
- Neighborhoods that lie exactly in a plane (λ₁ <= 1e-12 λ₃) are left out of `mme`. The original keeps those whose
  determinant happens to be positive after rounding.
- `read_orthogonal_subset` never runs a pickle; see there for the files it reads.
- Normals that `extract_orthogonal_subsets` estimates have their largest component positive, while the original leaves
  their sign, and so its choice of points, to rounding. A cloud with normals keeps them in both, and then both find the
  same points. The directions come with the largest first.
- `aggregate_map` gives a small object with `.points`, without colors; see `PointCloud`.
- Wrong input is a ValueError that names the argument.
"""

from trysquare.compat.map_metrics._clouds import PointCloud
from trysquare.compat.map_metrics.config import BaseConfig, CustomConfig, DepthConfig, LidarConfig
from trysquare.compat.map_metrics.metrics import aggregate_map, mme, mom, mpv
from trysquare.compat.map_metrics.utils.orthogonal import extract_orthogonal_subsets, read_orthogonal_subset

__all__ = [
    "BaseConfig",
    "CustomConfig",
    "DepthConfig",
    "LidarConfig",
    "PointCloud",
    "aggregate_map",
    "extract_orthogonal_subsets",
    "mme",
    "mom",
    "mpv",
    "read_orthogonal_subset",
]
