# SPDX-License-Identifier: Apache-2.0
"""evaluate() gives what the command prints, and takes what users have."""

from __future__ import annotations

import json
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import pose

import trysquare as ts


def write_room(folder: Path, room: Any) -> tuple[Path, Path]:
    scans, poses = room
    (folder / "scans").mkdir()
    for i, scan in enumerate(scans):
        np.save(folder / "scans" / f"{i:06}.npy", scan)
    ts.write_trajectory(folder / "poses.txt", poses, format="kitti")
    return folder / "scans", folder / "poses.txt"


def printed_by(command: Path, *arguments: Any) -> dict[str, Any]:
    run = subprocess.run([command, *map(str, arguments), "--json", "-"], capture_output=True, text=True, check=False)
    assert run.stdout, run.stderr
    result: dict[str, Any] = json.loads(run.stdout)
    return result


def test_files_give_the_json_of_the_command(tmp_path: Path, room: Any, command: Path) -> None:
    scans, poses = write_room(tmp_path, room)
    printed = printed_by(command, "evaluate", scans, poses, "--radius", 0.5, "--window", 3)
    result = ts.evaluate(ts.open_dataset(scans, poses), radius_m=0.5, window=3)
    assert json.loads(result.to_json()) == printed
    assert len(printed["windows"]) == 2


def test_arrays_give_the_numbers_of_the_files(tmp_path: Path, room: Any, command: Path) -> None:
    printed = printed_by(command, "evaluate", *write_room(tmp_path, room), "--radius", 0.5)
    result = ts.evaluate(*room, radius_m=0.5)
    for key in ("metrics", "overlap", "rpe_estimate", "windows", "verdict", "trajectory", "world_from_map", "settings"):
        assert json.loads(result.to_json())[key] == printed[key], key
    assert result.mom is not None and result.mom.value == printed["metrics"]["mom"]["value"]


def test_a_sequence_that_loads_one_scan_at_a_time(room: Any) -> None:
    scans, poses = room

    class Lazy:
        def __init__(self) -> None:
            self.asked: list[int] = []

        def __len__(self) -> int:
            return len(scans)

        def __getitem__(self, index: int) -> Any:
            self.asked.append(index)
            return scans[index]

    lazy = Lazy()
    wanted = ts.evaluate(scans, poses, radius_m=0.5, threads=2)
    assert ts.evaluate(lazy, poses, radius_m=0.5, threads=2).to_json() == wanted.to_json()
    assert set(lazy.asked) == set(range(len(scans)))


def test_an_error_in_such_a_sequence_is_the_callers(room: Any) -> None:
    class Broken:
        def __len__(self) -> int:
            return len(room[0])

        def __getitem__(self, index: int) -> Any:
            raise RuntimeError("disk on fire")

    with pytest.raises(RuntimeError, match="disk on fire"):
        ts.evaluate(Broken(), room[1])


def test_clouds_with_points_are_taken(room: Any) -> None:
    class Cloud:
        def __init__(self, points: Any) -> None:
            self.points = points

    scans, poses = room
    wanted = ts.evaluate(scans, poses, metrics=["mpv"], radius_m=0.5)
    clouds = [Cloud(scan.tolist()) for scan in scans]
    assert ts.evaluate(clouds, poses, metrics=["mpv"], radius_m=0.5).to_json() == wanted.to_json()


def test_threads_change_nothing(room: Any) -> None:
    texts = {ts.evaluate(*room, radius_m=0.5, threads=threads).to_json() for threads in (1, 2, 3)}
    assert len(texts) == 1


def test_points_and_their_values_belong_together(room: Any) -> None:
    scans, poses = room
    result = ts.evaluate(scans, poses, metrics=["mpv", "mme"], radius_m=0.5, query_every=7)
    points = result.points
    assert points.points_in_map.shape == (sum(len(scan) for scan in scans), 3)
    assert np.array_equal(points.query_indices, np.arange(0, len(points.points_in_map), 7))
    assert np.array_equal(np.bincount(points.scan_of_point), [len(scan) for scan in scans])
    index = int(points.query_indices[10])
    query = points.points_in_map[index]
    near = points.points_in_map[((points.points_in_map - query) ** 2).sum(axis=1) < 0.25]
    assert points.num_neighbors[10] == len(near)
    variance = np.linalg.eigvalsh(np.cov(near.T))[0]
    assert points.plane_variances[10] == pytest.approx(variance, rel=1e-9)
    assert result.mpv is not None
    assert result.mpv.value == pytest.approx(np.nanmean(points.plane_variances), rel=1e-12)


def test_what_is_not_asked_for_is_none_with_a_reason(room: Any) -> None:
    result = ts.evaluate(*room, metrics="mpv")
    assert result.mom is None and result.rpe_estimate is None and result.reference is None
    assert result.why["rpe_estimate"] == "not asked for"
    assert "reference" in result.why


def test_what_is_undefined_is_none_and_never_zero() -> None:
    far_apart = np.arange(30.0).reshape(10, 3) * 100
    result = ts.evaluate([far_apart, far_apart], np.stack([np.eye(4)] * 2), metrics=["mme", "mpv"])
    assert result.mpv is not None and result.mme is not None
    assert result.mpv.value is None and result.mpv.reason
    assert result.mme.value is None and result.mme.num_too_few == 20
    assert not result.verdict.meaningful


def test_the_reference_gives_true_errors(room: Any) -> None:
    scans, poses = room
    moved = poses.copy()
    moved[3, 0, 3] += 0.3
    result = ts.evaluate(scans, moved, metrics="rpe", reference=poses)
    assert result.reference is not None
    # 5 of the 15 pairs hold pose 3, and each is off by 0.3 m.
    assert result.reference.rpe.rmse == pytest.approx(0.3 * np.sqrt(5 / 15), rel=1e-9)
    assert result.inputs.reference == "numpy array"


def test_the_estimate_finds_the_error_that_was_made(room: Any) -> None:
    scans, poses = room
    moved = ts.perturb(poses, translation_m=0.03, rotation_deg=0.05, seed=5)
    result = ts.evaluate(scans, moved, metrics="rpe", reference=poses)
    estimate = result.rpe_estimate
    assert estimate is not None and estimate.status == "measured" and estimate.interval_m is not None
    assert result.reference is not None
    assert estimate.interval_m[0] <= result.reference.rpe.rmse <= estimate.interval_m[1]
    assert [each.index for each in estimate.poses] == list(range(len(poses)))


def test_progress_is_told(room: Any) -> None:
    heard: list[tuple[str, int, int]] = []
    ts.evaluate(*room, metrics="mpv", progress=lambda *told: heard.append(told))
    assert heard and heard[-1][1] == heard[-1][2]


def test_results_can_be_pickled_and_written(tmp_path: Path, room: Any) -> None:
    result = ts.evaluate(*room, metrics="mpv", radius_m=0.5)
    again = pickle.loads(pickle.dumps(result))
    assert again.to_json() == result.to_json()
    assert np.array_equal(again.points.plane_variances, result.points.plane_variances, equal_nan=True)
    result.to_json(tmp_path / "evaluation.json")
    assert (tmp_path / "evaluation.json").read_text() == result.to_json()
    assert [each.name for each in tmp_path.iterdir()] == ["evaluation.json"]
    with pytest.raises(ts.IoError, match="missing"):
        result.to_json(tmp_path / "missing" / "evaluation.json")


def test_it_prints_as_one_line(room: Any) -> None:
    result = ts.evaluate(*room, metrics=["mpv", "rpe"], radius_m=0.5)
    assert result.mpv is not None and result.mpv.value is not None
    text = repr(result)
    assert "\n" not in text and len(text) < 300 and f"mpv {result.mpv.value:.6g} m2" in text and "mom" not in text
    lonely = np.arange(30.0).reshape(10, 3) * 100
    nothing = repr(ts.evaluate([lonely] * 2, np.stack([np.eye(4)] * 2), metrics="mpv"))
    assert "mpv undefined" in nothing and "means nothing" in nothing


def test_windows_become_rows(room: Any) -> None:
    pandas = pytest.importorskip("pandas")
    result = ts.evaluate(*room, metrics=["mpv"], radius_m=0.5, window=3)
    frame = result.to_pandas()
    assert list(frame["first"]) == [0, 3]
    assert frame["mpv"].tolist() == [window.mpv for window in result.windows]
    assert pandas.isna(frame["mom"]).all()
    whole = ts.evaluate(*room, metrics=["mpv"], radius_m=0.5).to_pandas()
    assert len(whole) == 1 and whole["last"][0] == 5


def test_a_map_is_judged_without_poses(room: Any, tmp_path: Path, command: Path) -> None:
    points = ts.evaluate(*room, metrics="mpv").points.points_in_map
    np.save(tmp_path / "map.npy", points)
    printed = printed_by(command, "map", tmp_path / "map.npy", "--radius", 0.5)
    result = ts.evaluate_map(points, radius_m=0.5)
    assert json.loads(result.to_json())["metrics"] == printed["metrics"]
    assert result.trajectory is None


def test_compare_gives_the_json_of_the_command(tmp_path: Path, room: Any, command: Path) -> None:
    scans, poses = write_room(tmp_path, room)
    worse = ts.perturb(room[1], translation_m=0.03, seed=3)
    ts.write_trajectory(tmp_path / "worse.txt", worse, format="kitti")
    printed = printed_by(command, "compare", scans, poses, tmp_path / "worse.txt")
    result = ts.compare(room[0], {"poses": room[1], "worse": worse})
    own = json.loads(result.to_json())
    for key in ("settings", "comparisons", "adjusted_from", "verdict"):
        assert own[key] == printed[key], key
    assert [each["rpe_m"] for each in own["trajectories"]] == [each["rpe_m"] for each in printed["trajectories"]]
    assert result["worse"].rpe_m is not None and result["poses"].rpe_m is not None
    assert result["worse"].rpe_m > result["poses"].rpe_m
    assert result.ranks()["poses"] == 1
    assert len(result.windows) == 2 * len({(w["first"], w["last"]) for w in result.windows})
    with pytest.raises(KeyError):
        result["best"]


def test_diagnose_gives_the_json_of_the_command(tmp_path: Path, room: Any, command: Path) -> None:
    scans, poses = write_room(tmp_path, room)
    printed = printed_by(command, "diagnose", scans, poses)
    result = ts.diagnose(ts.open_dataset(scans, poses))
    assert json.loads(result.to_json()) == printed


def test_diagnose_names_a_pose_that_was_moved(room: Any) -> None:
    scans, poses = room
    moved = poses.copy()
    moved[2, :3, 3] += [0.08, -0.06, 0.05]
    found = ts.diagnose(scans, moved)
    assert found.suspects is not None and [each.scan for each in found.suspects] == [2]
    assert any("2" in finding.message for finding in found.findings)


def test_refine_writes_the_poses_in_which_scans_agree(room: Any) -> None:
    scans, poses = room
    moved = ts.perturb(poses, translation_m=0.03, rotation_deg=0.05, seed=5)
    refined = ts.refine(scans, moved)
    assert refined.poses is not None
    before = ts.rpe(poses, moved, every_pair=True).every_pair
    after = ts.rpe(poses, refined.poses, every_pair=True).every_pair
    assert before is not None and after is not None
    assert after["translation_m"]["rmse"] < 0.1 * before["translation_m"]["rmse"]


def test_a_refusal_has_no_poses() -> None:
    ground = np.random.default_rng(0).uniform(-5, 5, (3000, 3)) * [1, 1, 0.001]
    refined = ts.refine([ground] * 4, np.stack([np.eye(4)] * 4))
    assert refined.poses is None
    assert refined.estimate.status == "refused" and refined.estimate.reasons
    assert refined.estimate.translation_rms_m is None and "refused" in refined.estimate.why["translation_rms_m"]


def test_a_data_set_brings_its_reference(tmp_path: Path, room: Any, command: Path) -> None:
    scans, poses = write_room(tmp_path, room)
    moved = tmp_path / "moved.txt"
    ts.write_trajectory(moved, ts.perturb(room[1], translation_m=0.03, seed=5))
    printed = printed_by(command, "evaluate", scans, moved, "--reference", poses, "--metrics", "mpv")
    result = ts.evaluate(ts.open_dataset(scans, moved, reference=poses), metrics="mpv")
    assert json.loads(result.to_json()) == printed
    assert result.reference is not None and result.reference.rpe.rmse > 0.01


def test_a_data_set_brings_its_extrinsic(tmp_path: Path, room: Any, command: Path) -> None:
    """Poses of the sensor to which a calibration is applied once more: only who knows it can name the mistake."""
    scans, poses = write_room(tmp_path, room)
    turned = np.array([[0, -1, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0.3]])
    (tmp_path / "calib.txt").write_text("Tr: " + " ".join(map(str, turned.ravel())) + "\n")
    dataset = ts.open_dataset(scans, poses)
    printed = printed_by(command, "evaluate", scans, poses, "--metrics", "mpv", "--radius", 0.5)
    assert json.loads(ts.evaluate(dataset, metrics="mpv", radius_m=0.5).to_json()) == printed
    found = printed_by(command, "diagnose", scans, poses)
    assert json.loads(ts.diagnose(dataset).to_json()) == found
    named = json.dumps([found["findings"], printed["warnings"]])
    assert "calib" in named or "extrinsic" in named


def test_a_data_set_brings_its_times(tmp_path: Path, room: Any, command: Path) -> None:
    (tmp_path / "velodyne").mkdir()
    for i, scan in enumerate(room[0]):
        np.hstack([scan, np.zeros((len(scan), 1))]).astype(np.float32).tofile(tmp_path / "velodyne" / f"{i:06}.bin")
    times = np.arange(-25, 51) * 0.02  # poses at 50 Hz, also before and after the scans
    path = np.array([pose(t, [3 + 2 * t, 3 + t, 1.5]) for t in times])
    stamps = np.round(times * 1e9).astype(np.int64) + 10**9
    (tmp_path / "times.txt").write_text("\n".join(f"{1 + 0.1 * i:.6f}" for i in range(6)) + "\n")
    ts.write_trajectory(tmp_path / "poses.tum", path, format="tum", stamps_ns=stamps)
    dataset = ts.open_dataset(tmp_path / "velodyne", tmp_path / "poses.tum")
    assert dataset.all_stamps_ns is not None and np.array_equal(dataset.all_stamps_ns, stamps)
    printed = printed_by(command, "diagnose", tmp_path / "velodyne", tmp_path / "poses.tum")
    own = json.loads(ts.diagnose(dataset).to_json())
    assert own == printed
    assert own["time_offset"]["num_scans"] > 0


def test_windows_of_a_comparison_are_none_where_nothing_was_measured(room: Any) -> None:
    scans, poses = room
    others = {"true": poses, "off": ts.perturb(poses, translation_m=0.03, seed=3)}
    result = ts.compare(scans, others, metrics="mpv", radius_m=0.5)
    assert result.windows and all(row["mom_m2"] is None and row["mpv_m2"] > 0 for row in result.windows)


def test_a_sequence_is_asked_by_one_thread_at_a_time(room: Any) -> None:
    scans, poses = room

    class Slow:
        inside = most = 0

        def __len__(self) -> int:
            return len(scans)

        def __getitem__(self, index: int) -> Any:
            self.inside += 1
            self.most = max(self.most, self.inside)
            time.sleep(0.005)  # lets other threads in
            self.inside -= 1
            return scans[index]

    slow = Slow()
    ts.evaluate(slow, poses, metrics="mpv", threads=2)
    assert slow.most == 1


def test_an_interrupt_in_the_progress_is_not_lost(room: Any, request: pytest.FixtureRequest) -> None:
    # A shell has its background jobs ignore interrupts, this one among them.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))

    def interrupted(*told: Any) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ts.evaluate(*room, metrics="mpv", radius_m=0.5, progress=interrupted)
        time.sleep(0.01)  # where the interpreter looks for interrupts at the latest


def test_what_a_progress_raises_does_not_stop_the_work(room: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Any] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda told: seen.append(told.exc_value))

    def broken(*told: Any) -> None:
        raise RuntimeError("no terminal")

    result = ts.evaluate(*room, metrics="mpv", radius_m=0.5, progress=broken)
    assert result.mpv is not None and result.mpv.value is not None
    assert seen and all(str(each) == "no terminal" for each in seen)


def test_poses_of_ones_own_meet_the_reference_of_the_data_set(tmp_path: Path, room: Any) -> None:
    scans, poses = write_room(tmp_path, room)
    dataset = ts.open_dataset(scans, poses, reference=poses)
    result = ts.evaluate(dataset, ts.perturb(room[1], translation_m=0.1, seed=1), metrics="mpv")
    assert result.reference is not None and result.reference.rpe.rmse > 0.05


def test_a_calibration_of_the_reference_is_named(tmp_path: Path, room: Any, command: Path) -> None:
    scans, poses = write_room(tmp_path, room)
    (tmp_path / "truth").mkdir()
    reference = tmp_path / "truth" / "poses.txt"
    ts.write_trajectory(reference, room[1])
    (tmp_path / "truth" / "calib.txt").write_text("Tr: 1 0 0 0.1 0 1 0 0 0 0 1 0\n")
    printed = printed_by(command, "evaluate", scans, poses, "--reference", reference, "--metrics", "mpv")
    assert printed["inputs"]["reference_extrinsic"] == "calib.txt:Tr"
    assert (
        json.loads(ts.evaluate(ts.open_dataset(scans, poses, reference=reference), metrics="mpv").to_json()) == printed
    )


def test_files_are_written_through_links(tmp_path: Path, room: Any) -> None:
    (tmp_path / "target.json").write_text("older")
    (tmp_path / "link.json").symlink_to(tmp_path / "target.json")
    result = ts.evaluate(*room, metrics="mpv", radius_m=0.5)
    result.to_json(tmp_path / "link.json")
    assert (tmp_path / "link.json").is_symlink() and (tmp_path / "target.json").read_text() == result.to_json()
