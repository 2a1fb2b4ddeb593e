# SPDX-License-Identifier: Apache-2.0
"""Writers (and the readers that check them) for the formats of the command, with the standard library only."""

import math
import struct
from pathlib import Path


def write_bin(path, points):
    """KITTI .bin: x y z intensity, float32."""
    Path(path).write_bytes(b"".join(struct.pack("<4f", *p, 0.5) for p in points))


def write_nuscenes(path, points):
    """nuScenes .pcd.bin: x y z intensity ring, float32."""
    Path(path).write_bytes(b"".join(struct.pack("<5f", *p, 0.5, 3.0) for p in points))


def pcd_header(num_points, encoding, size=4):
    return (
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\n"
        f"SIZE {size} {size} {size}\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {num_points}\nHEIGHT 1\n"
        f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {num_points}\nDATA {encoding}\n"
    )


def lzf_of_literals(data):
    """A valid LZF stream without any back reference: runs of up to 32 bytes, each after its length - 1."""
    return b"".join(bytes([len(data[i : i + 32]) - 1]) + data[i : i + 32] for i in range(0, len(data), 32))


def pcd_bytes(points, encoding="binary", double=False):
    header = pcd_header(len(points), encoding, 8 if double else 4).encode()
    letter = "d" if double else "f"
    if encoding == "ascii":
        return header + "".join(" ".join(number(v) for v in p) + "\n" for p in points).encode()
    if encoding == "binary":
        return header + b"".join(struct.pack(f"<3{letter}", *p) for p in points)
    body = b"".join(struct.pack(f"<{len(points)}{letter}", *(p[axis] for p in points)) for axis in range(3))
    compressed = lzf_of_literals(body)
    return header + struct.pack("<2I", len(compressed), len(body)) + compressed


def write_pcd(path, points, encoding="binary", double=False):
    Path(path).write_bytes(pcd_bytes(points, encoding, double))


def ply_header(num_points, encoding, type_name="float"):
    return (
        f"ply\nformat {encoding} 1.0\ncomment made by a test\nelement vertex {num_points}\n"
        f"property {type_name} x\nproperty {type_name} y\nproperty {type_name} z\nend_header\n"
    )


def ply_bytes(points, encoding="binary_little_endian", double=False):
    header = ply_header(len(points), encoding, "double" if double else "float").encode()
    if encoding == "ascii":
        return header + "".join(" ".join(number(v) for v in p) + "\n" for p in points).encode()
    order = "<" if encoding == "binary_little_endian" else ">"
    return header + b"".join(struct.pack(f"{order}3{'d' if double else 'f'}", *p) for p in points)


def write_ply(path, points, encoding="binary_little_endian", double=False):
    Path(path).write_bytes(ply_bytes(points, encoding, double))


def write_xyz(path, points):
    Path(path).write_text("".join(" ".join(number(v) for v in p) + "\n" for p in points))


def write_csv(path, points):
    Path(path).write_text("x,y,z\n" + "".join(",".join(number(v) for v in p) + "\n" for p in points))


def npy_header(descr, shape, fortran_order=False):
    text = f"{{'descr': '{descr}', 'fortran_order': {fortran_order}, 'shape': {shape!r}, }}"
    text += " " * (63 - (10 + len(text)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode("latin-1")


def npy_bytes(points, double=True):
    letter = "d" if double else "f"
    header = npy_header("<f8" if double else "<f4", (len(points), 3))
    return header + b"".join(struct.pack(f"<3{letter}", *p) for p in points)


def write_npy(path, points, double=True):
    Path(path).write_bytes(npy_bytes(points, double))


def number(value):
    """17 significant digits: reads back to the same bits."""
    return "nan" if math.isnan(value) else f"{value:.17g}"


def write_kitti(path, poses):
    Path(path).write_text("".join(" ".join(number(v) for row in p for v in row) + "\n" for p in poses))


def read_kitti(path):
    rows = [[float(w) for w in line.split()] for line in Path(path).read_text().splitlines() if line.strip()]
    return [[row[0:4], row[4:8], row[8:12]] for row in rows]


def write_matrices(folder, poses):
    """One 4×4 per file, named so that only the natural order is the right one."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for i, pose in enumerate(poses):
        rows = [*pose, [0.0, 0.0, 0.0, 1.0]]
        text = "".join(" ".join(number(v) for v in row) + "\n" for row in rows)
        (Path(folder) / f"pose-{i}.txt").write_text(text)


def quaternion(pose):
    """x y z w, w >= 0; Shepperd's method restricted to the largest component."""
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = pose
    squares = [1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i]
    largest = squares.index(max(squares))
    unnormalised = [
        [squares[0], b + d, c + g, h - f],
        [b + d, squares[1], f + h, c - g],
        [c + g, f + h, squares[2], d - b],
        [h - f, c - g, d - b, squares[3]],
    ][largest]
    norm = math.copysign(math.sqrt(sum(v * v for v in unnormalised)), unnormalised[3])
    return [v / norm for v in unnormalised]


def write_tum(path, poses, stamps=None):
    lines = []
    for i, pose in enumerate(poses):
        stamp = f"{i * 0.1:.9f}" if stamps is None else stamps[i]
        lines.append(" ".join([stamp, *(number(row[3]) for row in pose), *(number(v) for v in quaternion(pose))]))
    Path(path).write_text("# timestamp tx ty tz qx qy qz qw\n" + "\n".join(lines) + "\n")


def read_tum(path):
    lines = [line for line in Path(path).read_text().splitlines() if line.strip() and not line.startswith("#")]
    return [[float(w) for w in line.split()] for line in lines]


PLY_TYPES = {
    "float": "f",
    "float32": "f",
    "double": "d",
    "float64": "d",
    "uchar": "B",
    "uint8": "B",
    "int": "i",
    "int32": "i",
    "uint": "I",
    "uint32": "I",
    "ushort": "H",
    "uint16": "H",
}


def read_ply(path):
    """Columns of a binary little endian PLY: name → list of numbers."""
    data = Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode("ascii").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise ValueError(f"{path}: not binary little endian")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    properties = [line.split()[1:] for line in lines if line.startswith("property")]
    row = struct.Struct("<" + "".join(PLY_TYPES[kind] for kind, _ in properties))
    if len(data) - end != count * row.size:
        raise ValueError(f"{path}: {len(data) - end} bytes for {count} rows of {row.size}")
    rows = list(row.iter_unpack(data[end:]))
    return {name: [r[i] for r in rows] for i, (_, name) in enumerate(properties)}


def write_dataset(folder, scans, poses, writer=write_bin, extension=".bin"):
    """A folder of scans and a KITTI poses file; returns (scans folder, poses file)."""
    folder = Path(folder)
    (folder / "scans").mkdir(parents=True, exist_ok=True)
    for i, points in enumerate(scans):
        writer(folder / "scans" / f"scan-{i}{extension}", points)
    write_kitti(folder / "poses.txt", poses)
    return folder / "scans", folder / "poses.txt"


def write_subset(folder, directions):
    """One NPY per direction; returns the glob that finds them."""
    for i, points in enumerate(directions):
        write_npy(Path(folder) / f"orth-{i}.npy", points)
    return str(Path(folder) / "orth-*.npy")
