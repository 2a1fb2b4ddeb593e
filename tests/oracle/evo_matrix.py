#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What evo says for a matrix of options: evo_matrix.py TRAJECTORIES OUTPUT.json

Needs evo 1.36. Each record has the arguments of `trysquare` and evo's statistics (null where evo has no pairs).
"""

import copy
import json
import sys
from pathlib import Path

from evo.core import filters, metrics, sync
from evo.core.trajectory import Plane, PoseTrajectory3D
from evo.core.units import Unit
from evo.main_ape import ape
from evo.main_rpe import rpe
from evo.tools import file_interface

CASES = {
    "kitti": ("KITTI_00_gt.txt", "KITTI_00_ORB.txt"),
    "tum": ("fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt"),
    "euroc": ("V102_groundtruth.csv", "V102.txt"),
}
RELATIONS = {
    "full": metrics.PoseRelation.full_transformation,
    "trans_part": metrics.PoseRelation.translation_part,
    "rot_part": metrics.PoseRelation.rotation_part,
    "angle_deg": metrics.PoseRelation.rotation_angle_deg,
    "angle_rad": metrics.PoseRelation.rotation_angle_rad,
    "point_distance": metrics.PoseRelation.point_distance,
    "point_distance_error_ratio": metrics.PoseRelation.point_distance_error_ratio,
}
ALIGNMENTS = {
    (): {},
    ("-a",): {"align": True},
    ("-s",): {"correct_scale": True},
    ("-as",): {"align": True, "correct_scale": True},
    ("--align_origin",): {"align_origin": True},
    ("-as", "--n_to_align", "200"): {"align": True, "correct_scale": True, "n_to_align": 200},
}
UNITS = {"f": Unit.frames, "m": Unit.meters, "d": Unit.degrees, "r": Unit.radians}


def read(case, folder):
    reference, estimate = (str(folder / name) for name in CASES[case])
    if case == "kitti":
        return file_interface.read_kitti_poses_file(reference), file_interface.read_kitti_poses_file(estimate)
    read_reference = (
        file_interface.read_euroc_csv_trajectory if case == "euroc" else file_interface.read_tum_trajectory_file
    )
    return read_reference(reference), file_interface.read_tum_trajectory_file(estimate)


def associated(pair, **options):
    if not isinstance(pair[0], PoseTrajectory3D):
        return copy.deepcopy(pair)
    return sync.associate_trajectories(*copy.deepcopy(pair), **options)


def ape_options():
    """Arguments, and evo's: every relation with every alignment, planes and units for some."""
    for relation in list(RELATIONS)[:6]:
        for words, alignment in ALIGNMENTS.items():
            yield [*words, "-r", relation], dict(alignment, pose_relation=RELATIONS[relation])
    for plane in ("xy", "xz", "yz"):
        for relation in ("trans_part", "full"):
            arguments = ["-a", "-r", relation, "--project_to_plane", plane]
            yield arguments, {"align": True, "pose_relation": RELATIONS[relation], "project_to_plane": Plane(plane)}
    for unit, relation in (("mm", "trans_part"), ("cm", "trans_part"), ("km", "point_distance"), ("rad", "angle_deg"), ("deg", "angle_rad")):
        arguments = ["-a", "-r", relation, "--change_unit", unit]
        yield arguments, {"align": True, "pose_relation": RELATIONS[relation], "change_unit": Unit(unit)}


def rpe_options():
    """Every relation by frames; every unit of delta, consecutive and all pairs, by three relations."""
    for relation in RELATIONS:
        for words, alignment in (((), {}), (("-as",), ALIGNMENTS[("-as",)])):
            yield [*words, "-r", relation], dict(alignment, pose_relation=RELATIONS[relation], delta=1, delta_unit=Unit.frames)
    pairs = (("f", 10, False), ("f", 10, True), ("m", 1.5, False), ("m", 1.5, True), ("m", 10, True), ("d", 5, False), ("r", 0.2, False))
    for unit, delta, all_pairs in pairs:
        for relation in ("trans_part", "angle_deg", "point_distance_error_ratio"):
            words = ["-r", relation, "-d", str(delta), "-u", unit, *(["--all_pairs"] if all_pairs else [])]
            options = {"pose_relation": RELATIONS[relation], "delta": delta, "delta_unit": UNITS[unit], "all_pairs": all_pairs}
            yield words, options
    for from_reference in (False, True):
        words = ["-d", "3", "-u", "m", "--all_pairs", "--delta_tol", "0.25", *(["--pairs_from_reference"] if from_reference else [])]
        options = {"pose_relation": RELATIONS["trans_part"], "delta": 3, "delta_unit": Unit.meters, "all_pairs": True}
        yield words, dict(options, rel_delta_tol=0.25, pairs_from_reference=from_reference)
    yield ["-d", "2", "-u", "m", "--project_to_plane", "xz", "--change_unit", "cm"], {
        "pose_relation": RELATIONS["trans_part"], "delta": 2, "delta_unit": Unit.meters,
        "project_to_plane": Plane.XZ, "change_unit": Unit.centimeters,
    }  # fmt: skip


def angle_pairs_options():
    """All pairs by angle: quadratic, so on one short data set only."""
    for unit, delta in (("d", 20), ("r", 0.5)):
        words = ["-r", "angle_deg", "-d", str(delta), "-u", unit, "--all_pairs", "--downsample", "300"]
        yield words, {"pose_relation": RELATIONS["angle_deg"], "delta": delta, "delta_unit": UNITS[unit], "all_pairs": True}


def record_of(verb, function, files, words, pair, options):
    record = {"arguments": [verb, *files, *words], "stats": None, "num_pairs": 0}
    try:
        result = function(*copy.deepcopy(pair), **options)
        record["stats"] = {k: float(v) for k, v in result.stats.items()}
        record["num_pairs"] = len(result.np_arrays["error_array"])
    except filters.FilterException:
        pass
    return record


def preparations(pair):
    """What is done before: arguments, and what evo makes of the pair."""
    yield ["--t_max_diff", "0.02"], associated(pair, max_diff=0.02)
    yield ["--t_offset", "0.005"], associated(pair, offset_2=0.005)
    yield ["--t_offset", "-0.5"], associated(pair, offset_2=-0.5)
    few = copy.deepcopy(pair)
    for trajectory in few:
        trajectory.downsample(1500)
    yield ["--downsample", "1500", "--t_max_diff", "0.02"], associated(few, max_diff=0.02)
    moving = copy.deepcopy(pair)
    for trajectory in moving:
        trajectory.motion_filter(0.01, 1.0, True)
    yield ["--motion_filter", "0.01", "1.0", "--t_max_diff", "0.02"], associated(moving, max_diff=0.02)
    middle = copy.deepcopy(pair)
    start = float(f"{middle[0].timestamps[len(middle[0].timestamps) // 3]:.4f}")
    end = float(f"{middle[0].timestamps[2 * len(middle[0].timestamps) // 3]:.4f}")
    middle[0].reduce_to_time_range(start, end)
    yield ["--t_start", repr(start), "--t_end", repr(end)], associated(middle)


def records(folder):
    for case in CASES:
        files = [str(folder / name) for name in CASES[case]]
        raw = read(case, folder)
        pair = associated(raw)
        for words, options in ape_options():
            yield record_of("ape", ape, files, words, pair, options)
        for words, options in rpe_options():
            yield record_of("rpe", rpe, files, words, pair, options)
        if case == "kitti":
            few = copy.deepcopy(raw)
            for trajectory in few:
                trajectory.downsample(300)
            for words, options in angle_pairs_options():
                yield record_of("rpe", rpe, files, words, few, options)
            continue
        for words, prepared in preparations(raw):
            options = {"align": True, "pose_relation": RELATIONS["trans_part"]}
            yield record_of("ape", ape, files, [*words, "-a"], prepared, options)


def main():
    folder, output = (Path(word) for word in sys.argv[1:])
    output.write_text(json.dumps(list(records(folder))))


if __name__ == "__main__":
    main()
