# SPDX-License-Identifier: Apache-2.0
"""Points of sensor_msgs/PointCloud2. Knows no rosbags: a message is anything with its fields."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_DATATYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
"""sensor_msgs/PointField's INT8 to FLOAT64."""


def points_of(message: Any) -> NDArray[np.float64]:
    """x, y and z of a PointCloud2, (N, 3), row by row, in the units and frame of the message.

    Fields may come in any order, with gaps and with others between; of any datatype, either byte order, organized or
    not, and with rows that are padded. Invalid returns stay, whatever is_dense says.

    Raises:
        ValueError: a field x, y or z is missing, there twice, or not inside a point; the data are too short.

    Source: definitions of sensor_msgs/PointCloud2 and PointField.
    """
    height, width = int(message.height), int(message.width)
    step, row_step = int(message.point_step), int(message.row_step)
    if height * width == 0:
        return np.empty((0, 3))
    point = _point_type(message.fields, step, ">" if message.is_bigendian else "<")
    if height > 1 and row_step < width * step:
        raise ValueError(f"row_step is {row_step}, expected {width * step} or more: {width} points of {step} bytes")
    data = np.ascontiguousarray(np.frombuffer(message.data, dtype=np.uint8))
    needed = (height - 1) * row_step + width * step  # the padding of the last row may be left out
    if data.size < needed:
        raise ValueError(f"data has {data.size} bytes, expected {needed} for {height} x {width} points")
    table = np.ndarray((height, width), point, data, strides=(row_step, step))
    points = np.empty((height * width, 3))
    for axis, name in enumerate("xyz"):
        points[:, axis] = table[name].reshape(-1)
    return points


def _point_type(fields: Any, point_step: int, byte_order: str) -> np.dtype[Any]:
    """Of the three coordinates alone, at their places inside a point."""
    formats, offsets = [], []
    for name in "xyz":
        same = [field for field in fields if field.name == name]
        if len(same) != 1:
            names = " ".join(field.name for field in fields)
            raise ValueError(f"found {len(same)} fields called {name}, expected one (fields: {names})")
        field = same[0]
        if field.datatype not in _DATATYPES:
            raise ValueError(f"field {name} has the datatype {field.datatype}, expected 1 to 8")
        if field.count > 1:
            raise ValueError(f"field {name} has {field.count} values, expected one")
        formats.append(np.dtype(byte_order + _DATATYPES[field.datatype]))
        offsets.append(int(field.offset))
        if offsets[-1] + formats[-1].itemsize > point_step:
            raise ValueError(
                f"field {name} ends at byte {offsets[-1] + formats[-1].itemsize} of {point_step} of a point"
            )
    return np.dtype({"names": list("xyz"), "formats": formats, "offsets": offsets, "itemsize": point_step})
