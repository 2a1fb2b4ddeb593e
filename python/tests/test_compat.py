# SPDX-License-Identifier: Apache-2.0
"""The drop-in of map-metrics against what the original gave; compat_scenes.py is the command that gave it."""

from __future__ import annotations

import math
import pickle
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from compat_scenes import CONFIGS, SPARSE, normals, orthogonal_subset, scans_and_poses

import trysquare as ts
from trysquare.compat import map_metrics
from trysquare.compat.map_metrics.config import BaseConfig, CustomConfig, DepthConfig, LidarConfig
from trysquare.compat.map_metrics.metrics import aggregate_map, mme, mom, mpv
from trysquare.compat.map_metrics.utils.orthogonal import extract_orthogonal_subsets, read_orthogonal_subset

# map-metrics 0.0.4 with open3d 0.18.0, scikit-learn 1.9.1, numpy 1.26.4
ORIGINAL: dict[str, Any] = {
    "mme sparse": -7.361282633424499,
    "mpv sparse": 0.00014769111814697314,
    "mom sparse": 0.00029198061896322855,
    "mme lidar": -0.2174156388031642,
    "mpv lidar": 0.015010125010621525,
    "mom lidar": 0.01030246713211181,
    "extracted lidar": [
        [77, -5.74819, -1.265849, -115.560627, -0.0035432342714, 0.0128892747579, 0.999910652052],
        [68, -21.678958, -134.546168, 33.81663, 0.0834850911146, 0.996311866546, 0.0198218097478],
        [62, -123.270181, 14.534927, 31.13435, 0.993979016529, -0.106597023549, -0.0253532891617],
    ],
    "mom of extracted lidar": 0.0010336969165443694,
    "mme depth": -4.43149827089263,
    "mpv depth": 0.00044780431755297106,
    "mom depth": 0.0010075850034978891,
    "extracted depth": [
        [74, -38.608552, -20.708003, -110.944933, -0.00140352955567, 0.0011665582612, 0.999998334622],
        [62, -125.649636, -10.985429, 12.500944, 0.994529945797, -0.104317524775, 0.00529536952719],
        [41, -31.540252, -79.192781, -1.5634, 0.115968654855, 0.993234672734, -0.0060129835353],
    ],
    "mom of extracted depth": 0.0009148399046380539,
    "mme custom": -3.467725088967441,
    "mpv custom": 0.0007637653093207233,
    "mom custom": 0.0010843693198669493,
    "extracted custom": [
        [93, -187.614067, -6.042167, 15.262094, 0.99524563872, -0.0973844135619, 0.00154745055364],
        [91, -44.968176, -34.877474, -136.548677, -0.00769356093758, -0.009347252734, 0.999926716308],
        [90, -59.986003, -174.806119, 8.97415, 0.0727927239694, 0.997315002647, -0.00800030198734],
    ],
    "mom of extracted custom": 0.0009746683388750347,
    "mme of three points": 0.0,
    "mpv of three points": 0.0,
}

FEW = np.eye(3)  # three points: no neighborhood has more than five


class Open3dCloud:
    """What is used of Open3D's cloud: `points` and `normals` are no arrays, but become some."""

    def __init__(self, points: Any, cloud_normals: Any = None) -> None:
        self.points = memoryview(np.ascontiguousarray(points, dtype=np.float64).data)
        self.normals = memoryview(
            np.ascontiguousarray([] if cloud_normals is None else cloud_normals, dtype=np.float64)
        )

    def has_normals(self) -> bool:
        return len(self.normals) > 0


class TensorCloud:
    """What is used of Open3D's tensor cloud: tensors by name, of floats."""

    class Tensor:
        def __init__(self, values: Any) -> None:
            self.values = np.asarray(values, dtype=np.float32)

        def cpu(self) -> TensorCloud.Tensor:
            return self

        def numpy(self) -> Any:
            return self.values

    def __init__(self, **tensors: Any) -> None:
        self.point = {name: self.Tensor(values) for name, values in tensors.items()}


@pytest.fixture(scope="module")
def scene() -> tuple[list[Any], list[Any]]:
    return scans_and_poses()


@pytest.mark.parametrize("name", CONFIGS)
def test_metrics_are_those_of_the_original(name: str, scene: Any) -> None:
    scans, poses = scene
    config = CustomConfig(**CONFIGS[name])
    assert mme(scans, poses, config) == pytest.approx(ORIGINAL[f"mme {name}"], rel=1e-9)
    assert mpv(scans, poses, config) == pytest.approx(ORIGINAL[f"mpv {name}"], rel=1e-9)
    subset = orthogonal_subset(scans[0])
    assert mom(scans, poses, subset, config) == pytest.approx(ORIGINAL[f"mom {name}"], rel=1e-9)


def test_the_original_asks_for_six_neighbors_and_in_mom_for_four(scene: Any) -> None:
    scans, poses = scene
    config = CustomConfig(**SPARSE)
    assert mme(scans, poses, config) == pytest.approx(ORIGINAL["mme sparse"], rel=1e-9)
    assert mpv(scans, poses, config) == pytest.approx(ORIGINAL["mpv sparse"], rel=1e-9)
    assert mom(scans, poses, orthogonal_subset(scans[0]), config) == pytest.approx(ORIGINAL["mom sparse"], rel=1e-9)


@pytest.mark.parametrize("name", CONFIGS)
def test_the_subset_of_a_cloud_with_normals_is_that_of_the_original(name: str, scene: Any) -> None:
    scans, poses = scene
    config = CustomConfig(**CONFIGS[name])
    cloud = Open3dCloud(scans[0], normals(scans[0]))
    points, point_normals, means = extract_orthogonal_subsets(cloud, config)
    found = [[len(p), *p.sum(axis=0), *m] for p, m in zip(points, means, strict=True)]
    np.testing.assert_allclose(found, ORIGINAL[f"extracted {name}"], rtol=1e-9)
    for each, mean in zip(point_normals, means, strict=True):
        np.testing.assert_allclose(each.mean(axis=0) / np.linalg.norm(each.mean(axis=0)), mean, atol=1e-12)
    value = mom([cloud, *scans[1:]], poses, config=config)
    assert value == pytest.approx(ORIGINAL[f"mom of extracted {name}"], rel=1e-9)


def test_normals_are_those_of_the_points_they_stand_beside(scene: Any) -> None:
    scans, _ = scene
    given = normals(scans[0])
    points, point_normals, _ = extract_orthogonal_subsets(Open3dCloud(scans[0], given))
    for each, its_normals in zip(points, point_normals, strict=True):
        index = [int(np.flatnonzero((scans[0] == point).all(axis=1))[0]) for point in each]
        np.testing.assert_array_equal(given[index], its_normals)


def test_a_cloud_without_normals_gets_those_of_its_walls(scene: Any) -> None:
    points, _, means = extract_orthogonal_subsets(scene[0][0], DepthConfig)
    assert [len(each) for each in points] == sorted([len(each) for each in points], reverse=True)
    np.testing.assert_allclose(np.abs(means @ np.transpose(means)), np.eye(3), atol=0.1)
    of_three_walls = np.abs(np.array(means) @ normals(scene[0][0])[[450, 1350, 2250]].T)
    np.testing.assert_allclose(of_three_walls.max(axis=0), 1, atol=0.02)


def test_settings_of_the_extraction_reach_it(scene: Any) -> None:
    scan = scene[0][0]
    sizes = {len(p) for p in extract_orthogonal_subsets(scan, CustomConfig(knn_rad=0.3))[0]}
    assert sizes != {len(p) for p in extract_orthogonal_subsets(scan, CustomConfig(knn_rad=0.3, max_nn=8))[0]}
    with pytest.raises(ValueError, match=r"found 0 mutually orthogonal directions in \d+ planar points and 0 groups"):
        extract_orthogonal_subsets(scan, CustomConfig(min_clust_size=2000))
    with pytest.raises(ValueError, match="found 1 mutually orthogonal directions"):
        extract_orthogonal_subsets(scan, DepthConfig, eps=1e-9)
    with pytest.raises(ValueError, match=r"eps = 0\.5"):
        extract_orthogonal_subsets(scan, eps=0.5)


def test_the_map_is_in_the_frame_of_the_first_cloud(scene: Any) -> None:
    scans, poses = scene
    cloud = aggregate_map(scans, poses)
    np.testing.assert_allclose(cloud.points[: len(scans[0])], scans[0], atol=1e-12)
    moved = scans[2] @ (np.linalg.inv(poses[0]) @ poses[2])[:3, :3].T + (np.linalg.inv(poses[0]) @ poses[2])[:3, 3]
    np.testing.assert_allclose(cloud.points[-len(scans[2]) :], moved, atol=1e-12)
    assert np.asarray(cloud) is cloud.points
    assert np.asarray(cloud, dtype=np.float32).dtype == np.float32
    assert not np.shares_memory(np.array(cloud, copy=True), cloud.points)
    assert len(cloud) == 3 * 2700
    assert mme([cloud], [np.eye(4)], DepthConfig) == mme(scans, poses, DepthConfig)


def test_every_kind_of_cloud_gives_the_same(scene: Any) -> None:
    scans, poses = scene
    expected = mpv(scans, poses, DepthConfig)
    assert mpv([Open3dCloud(scan) for scan in scans], poses, DepthConfig) == expected
    assert mpv([np.asfortranarray(scan) for scan in scans], np.array(poses), DepthConfig) == expected
    in_floats = [scan.astype(np.float32) for scan in scans]
    tensors = [TensorCloud(positions=scan) for scan in in_floats]
    assert mpv(tensors, poses, DepthConfig) == mpv(in_floats, poses, DepthConfig)


def test_normals_of_a_tensor_cloud_count(scene: Any) -> None:
    scan = scene[0][0].astype(np.float32)
    given = normals(scene[0][0]).astype(np.float32)
    tensors = extract_orthogonal_subsets(TensorCloud(positions=scan, normals=given), DepthConfig)[1]
    arrays = extract_orthogonal_subsets(Open3dCloud(scan, given), DepthConfig)[1]
    for one, other in zip(tensors, arrays, strict=True):
        np.testing.assert_array_equal(one, other)


def test_nothing_is_not_zero() -> None:
    assert ORIGINAL["mme of three points"] == ORIGINAL["mpv of three points"] == 0
    for metric in (mme, mpv):
        with pytest.warns(ts.TrysquareWarning, match=f"{metric.__name__} is undefined: .+"):
            assert math.isnan(metric([FEW], [np.eye(4)]))


def test_mom_of_a_direction_without_neighbors_is_not_the_sum_of_the_others(scene: Any) -> None:
    scans, poses = scene
    subset = [*orthogonal_subset(scans[0])[:2], np.full((10, 3), 1e4)]
    with pytest.warns(ts.TrysquareWarning, match=r"no point of orth_list\[2\]"):
        assert math.isnan(mom(scans, poses, subset))
    with pytest.warns(ts.TrysquareWarning, match="orth_list is empty"):
        assert math.isnan(mom(scans, poses, []))


def test_a_warning_points_to_the_line_that_called() -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mpv([FEW], [np.eye(4)])
        mom([FEW], [np.eye(4)], [])
        mom([FEW], [np.eye(4)], [FEW])
    assert [warning.filename for warning in caught] == [__file__] * 3


def test_min_knn_is_a_bound_that_must_be_passed() -> None:
    six = np.random.default_rng(0).random((6, 3))
    with pytest.warns(ts.TrysquareWarning):
        assert math.isnan(mpv([six], [np.eye(4)], CustomConfig(knn_rad=5, min_knn=6)))
    assert mpv([six], [np.eye(4)], CustomConfig(knn_rad=5)) == pytest.approx(np.linalg.eigvalsh(np.cov(six.T))[0])


def test_configs_have_the_values_of_the_original() -> None:
    def values(config: Any) -> tuple[Any, ...]:
        return config.KNN_RAD, config.MIN_KNN, config.MAX_NN, config.MIN_CLUST_SIZE

    assert values(BaseConfig) == (None, None, None, None)
    assert values(LidarConfig) == values(CustomConfig()) == (1, 5, 30, 5)
    assert values(DepthConfig) == (0.2, 5, 30, 5)
    assert values(CustomConfig(2.0, 7, 11, 13)) == (2.0, 7, 11, 13)


class NegativeRadius(LidarConfig):
    KNN_RAD = -1.0


class TextKnn(LidarConfig):
    MIN_KNN = "many"  # type: ignore[assignment]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: mme([FEW], []), "found 1 point clouds and 0 poses"),
        (lambda: mme([], []), "ts: found no pose"),
        (lambda: mme([FEW], [np.eye(3)]), r"ts\[0\].*\(3, 3\)"),
        (lambda: mme([FEW], [np.zeros((4, 4))]), r"ts\[0\].*inverse"),
        (lambda: mme([FEW, np.zeros((3, 2))], [np.eye(4)] * 2), r"pcs\[1\].*\(3, 2\)"),
        (lambda: mpv([["a"]], [np.eye(4)]), r"pcs\[0\]"),
        (lambda: mom([FEW], [np.eye(4)], [FEW, np.zeros(3)]), r"orth_list\[1\].*\(3,\)"),
        (lambda: mme([FEW], [np.eye(4)], BaseConfig), r"config.KNN_RAD = None"),
        (lambda: mpv([FEW], [np.eye(4)], NegativeRadius), r"config.KNN_RAD = -1.0"),
        (lambda: mpv([FEW], [np.eye(4)], TextKnn), r"config.MIN_KNN = 'many'"),
        (lambda: extract_orthogonal_subsets(FEW), "none of its points lies in a plane"),
        (lambda: extract_orthogonal_subsets(FEW, CustomConfig(max_nn=2)), r"config.MAX_NN = 2"),
        (lambda: extract_orthogonal_subsets(Open3dCloud(FEW, np.eye(3)[:2])), r"pc.normals: found 2 for 3"),
        (lambda: read_orthogonal_subset("no.npz", "no.txt", []), "ts: found no pose"),
    ],
)
def test_wrong_arguments_are_named(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


@pytest.fixture
def pose_file(tmp_path: Path, scene: Any) -> Path:
    path = tmp_path / "pose.txt"
    np.savetxt(path, np.column_stack([scene[1][1], np.zeros(4)]))  # the pose of scan 1, and a fifth column
    return path


def test_a_subset_is_read_from_files_of_numbers(tmp_path: Path, pose_file: Path, scene: Any) -> None:
    scans, poses = scene
    subset = [each[: 10 + i] for i, each in enumerate(orthogonal_subset(scans[1]))]
    np.savez(tmp_path / "all.npz", *subset)
    for i, each in enumerate(subset):
        np.save(tmp_path / f"part-{i}.npy", each)
    np.save(tmp_path / "stack.npy", np.stack([each[:10] for each in subset]))
    relative = np.linalg.inv(poses[0]) @ poses[1]
    expected = [each @ relative[:3, :3].T + relative[:3, 3] for each in subset]
    for name in ("all.npz", "part-*.npy"):
        found = read_orthogonal_subset(tmp_path / name, pose_file, poses)
        assert len(found) == 3
        for one, other in zip(found, expected, strict=True):
            np.testing.assert_allclose(one, other, atol=1e-12)
    stack = read_orthogonal_subset(str(tmp_path / "stack.npy"), str(pose_file), poses)
    np.testing.assert_allclose(stack, [each[:10] for each in expected], atol=1e-12)


class Runs:
    """Leaves a file behind when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> Any:
        return Path.touch, (self.path,)


@pytest.mark.parametrize("kind", ["array", "archive", "pickle"])
def test_a_pickle_is_never_run(kind: str, tmp_path: Path, pose_file: Path) -> None:
    trap = tmp_path / "it-ran"
    path = tmp_path / "subset.npy"
    with path.open("wb") as file:
        if kind == "array":
            np.save(file, np.array([Runs(trap)], dtype=object), allow_pickle=True)
        elif kind == "archive":
            np.savez(file, np.array([Runs(trap)], dtype=object))
        else:
            pickle.dump(Runs(trap), file)
    with pytest.raises(ts.IoError, match=r"subset.npy: .*found a pickle.*numpy.savez"):
        read_orthogonal_subset(path, pose_file, [np.eye(4)])
    assert not trap.exists()
    np.load(path, allow_pickle=True) if kind != "archive" else np.load(path, allow_pickle=True)["arr_0"]
    assert trap.exists(), "the trap works"


def test_files_that_hold_no_subset_are_named(tmp_path: Path, pose_file: Path) -> None:
    eye = [np.eye(4)]
    with pytest.raises(ts.IoError, match=r"none-\*.npy: no such file"):
        read_orthogonal_subset(tmp_path / "none-*.npy", pose_file, eye)
    np.save(tmp_path / "flat.npy", np.zeros(5))
    with pytest.raises(ts.IoError, match=r"flat.npy: .*\(5,\)"):
        read_orthogonal_subset(tmp_path / "flat.npy", pose_file, eye)
    whole = tmp_path / "flat.npy"
    whole.write_bytes(whole.read_bytes()[:-9])
    with pytest.raises(ts.IoError, match=r"flat\.npy"):
        read_orthogonal_subset(whole, pose_file, eye)
    whole.write_bytes(b"")
    with pytest.raises(ts.IoError, match=r"flat\.npy"):
        read_orthogonal_subset(whole, pose_file, eye)
    (tmp_path / "broken.npz").write_bytes(b"PK\x03\x04 and no more")
    with pytest.raises(ts.IoError, match=r"broken\.npz"):
        read_orthogonal_subset(tmp_path / "broken.npz", pose_file, eye)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 0 0 0\n" * 3, "found 3 rows"),
        ("1 0 0\n" * 4, "four numbers"),
        ("a b c d\n" * 4, "four numbers"),
        ("", "rows"),
    ],
)
def test_pose_files_that_hold_no_pose_are_named(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "pose.txt").write_text(text)
    np.save(tmp_path / "subset.npy", np.zeros((3, 2, 3)))
    with pytest.raises(ts.IoError, match=f"pose.txt: .*{message}"):
        read_orthogonal_subset(tmp_path / "subset.npy", tmp_path / "pose.txt", [np.eye(4)])
    with pytest.raises(ts.IoError, match=r"nowhere\.txt"):
        read_orthogonal_subset(tmp_path / "subset.npy", tmp_path / "nowhere.txt", [np.eye(4)])


def test_names_are_where_the_original_has_them() -> None:
    for name in ("aggregate_map", "mme", "mpv", "mom"):
        assert getattr(map_metrics, name) is getattr(map_metrics.metrics, name)
    assert map_metrics.extract_orthogonal_subsets is map_metrics.utils.orthogonal.extract_orthogonal_subsets
    assert map_metrics.LidarConfig is map_metrics.config.LidarConfig


def test_open3d_is_not_imported() -> None:
    code = "import sys; from trysquare.compat import map_metrics; sys.exit('open3d' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
