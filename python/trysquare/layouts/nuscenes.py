# SPDX-License-Identifier: Apache-2.0
"""nuScenes.

    v1.0-mini/{scene,sample,sample_data,ego_pose,calibrated_sensor,sensor}.json     tables that refer by tokens
    samples/LIDAR_TOP/*.pcd.bin      key frames, two a second: x y z intensity ring, float32
    sweeps/LIDAR_TOP/*.pcd.bin       the scans between them, twenty a second

A row of sample_data names the file, its time [us], the pose of the car at that time in the global frame (ego_pose) and
where the sensor sits on the car (calibrated_sensor): global_from_sensor = ego_pose * calibrated_sensor. Quaternions are
w x y z. LIDAR_TOP has x to the right and y forward; all frames are right-handed. Source: Caesar et al., "nuScenes: A
multimodal dataset for autonomous driving", CVPR 2020, and schema_nuscenes.md of its devkit.

The part after the colon of `layout` chooses a scene by name or by index, and may end with /samples for key frames only:
"nuscenes:scene-0061", "nuscenes:0", "nuscenes:scene-0061/samples".
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare._core import IoError
from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, choose
from trysquare.layouts._rotations import pose_from_quaternion

_TABLES = ("scene", "sample", "sample_data", "ego_pose", "calibrated_sensor", "sensor")
_CHANNEL = "LIDAR_TOP"

Row = dict[str, Any]


def find_nuscenes(request: Request) -> LayoutFiles:
    """A scene of nuScenes: the folder above samples, sweeps and v1.0-*, or v1.0-* itself.

    Raises:
        NotThisLayout: naming what is missing, or the scenes that there are to choose from.
        IoError: a table or a scan is missing or malformed; the message names the file and the row.
    """
    tables, data = _table_folder(request.root)
    choice, key_frames_only = request.choice, False
    if choice is not None and choice.endswith("/samples"):
        choice, key_frames_only = choice.removesuffix("/samples") or None, True
    scenes = _rows(tables / "scene.json")
    names = [_text(row, "name", tables / "scene.json") for row in scenes]
    name = choose("scene", names, replace(request, choice=choice))
    token = _text(scenes[names.index(name)], "token", tables / "scene.json")
    rows = _scans_of(tables, token)
    if key_frames_only:
        rows = [row for row in rows if row.get("is_key_frame") is True]
    if not rows:
        raise IoError(f"{tables / 'sample_data.json'}: scene {name} has no scan of {_CHANNEL}")
    return LayoutFiles(
        "nuscenes",
        [_scan_file(data, row, tables) for row in rows],
        request.poses or _poses_of(tables, rows),
        "nuscenes",
        stamps_ns=np.array([row["timestamp"] for row in rows], dtype=np.int64) * 1000,
        extrinsic_source=f"calibrated_sensor:{_CHANNEL}",
    )


def _table_folder(root: Path) -> tuple[Path, Path]:
    """The folder of the tables, and the one that their file names are relative to."""
    if root.name.startswith("v1.0-") and (root / "sample_data.json").is_file():
        return root, root.parent
    folders = sorted(f for f in root.glob("v1.0-*") if f.is_dir())
    if not folders:
        raise NotThisLayout("no folder v1.0-*")
    if len(folders) > 1:
        raise NotThisLayout(f"several versions, {', '.join(f.name for f in folders)}: name the folder of one as root")
    missing = [name for name in _TABLES if not (folders[0] / f"{name}.json").is_file()]
    if missing:
        raise NotThisLayout(f"no file {folders[0].name}/{missing[0]}.json")
    return folders[0], root


def _scans_of(tables: Path, scene_token: str) -> list[Row]:
    """Rows of sample_data of the LiDAR in a scene, by time."""
    samples = {s["token"] for s in _rows(tables / "sample.json") if s.get("scene_token") == scene_token}
    sensors = {s["token"] for s in _rows(tables / "sensor.json") if s.get("channel") == _CHANNEL}
    if not sensors:
        raise IoError(f"{tables / 'sensor.json'}: no sensor with the channel {_CHANNEL}")
    mounted = {c["token"] for c in _rows(tables / "calibrated_sensor.json") if c.get("sensor_token") in sensors}
    path = tables / "sample_data.json"
    rows = [
        row
        for row in _rows(path)
        if row.get("sample_token") in samples and row.get("calibrated_sensor_token") in mounted
    ]
    for row in rows:
        if not isinstance(row.get("timestamp"), int):
            raise IoError(f"{path}: row {row['token']}: timestamp is {row.get('timestamp')!r}, expected whole µs")
    return sorted(rows, key=lambda row: int(row["timestamp"]))


def _poses_of(tables: Path, rows: list[Row]) -> NDArray[np.float64]:
    """global_from_sensor of each row, (M, 4, 4)."""
    ego = {row["token"]: row for row in _rows(tables / "ego_pose.json")}
    mount = {row["token"]: row for row in _rows(tables / "calibrated_sensor.json")}
    return np.stack(
        [_pose(ego, row, "ego_pose", tables) @ _pose(mount, row, "calibrated_sensor", tables) for row in rows]
    )


def _pose(table: dict[str, Row], row: Row, name: str, tables: Path) -> NDArray[np.float64]:
    token = row.get(f"{name}_token")
    if token not in table:
        raise IoError(f"{tables / f'{name}.json'}: no row {token}, which {row.get('filename')} refers to")
    try:
        return pose_from_quaternion(table[token]["translation"], table[token]["rotation"])
    except (KeyError, TypeError, ValueError) as error:
        raise IoError(f"{tables / f'{name}.json'}: row {token}: {error}") from None


def _scan_file(data: Path, row: Row, tables: Path) -> Path:
    path = data / _text(row, "filename", tables / "sample_data.json")
    if not path.is_file():
        raise IoError(f"{path}: no such file, but {tables / 'sample_data.json'} names it")
    return path


def _rows(path: Path) -> list[Row]:
    try:
        rows = json.loads(path.read_bytes())
    except OSError as error:
        raise IoError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise IoError(f"{path}: it is no JSON: {error}") from None
    if not isinstance(rows, list) or not all(isinstance(row, dict) and "token" in row for row in rows):
        raise IoError(f"{path}: expected a list of rows that have a token each")
    return rows


def _text(row: Row, key: str, path: Path) -> str:
    if not isinstance(row.get(key), str):
        raise IoError(f"{path}: row {row.get('token')}: {key} is {row.get(key)!r}, expected text")
    return str(row[key])
