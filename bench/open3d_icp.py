#!/usr/bin/env python3
"""A placement without a bound beside the point-to-plane ICP of Open3D (Debian: python3-open3d), on the same files.

    bench_castings write NUMBER FOLDER [POINTS]      # makes part.stl and blank.stl
    bench/open3d_icp.py LEKALO BENCH_CASTINGS PART BLANK [RUNS]

Both count from what they read, with vertices at one place already made one: lekalo its trees, the climb, the true
clearance and the contacts; Open3D the normals of what is matched with, its tree and the iteration, with all vertices
of both. Open3D is asked both ways round, as it comes, which ends after 30 steps, and until it settles by its own
measure. The runs alternate, and the least time of each counts. The clearance at its poses is what lekalo measures
there. A scan of a million points takes Open3D minutes the second way.
"""
import json
import subprocess
import sys
import tempfile
import time

import numpy
import open3d

lekalo, bench, part, blank = sys.argv[1:5]
runs = int(sys.argv[5]) if len(sys.argv) > 5 else 5
registration = open3d.pipelines.registration


def quaternion(r):
    """Of a rotation, as w, x, y, z."""
    rows = [[1 + r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], 1 + r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[0, 2] + r[2, 0]],
            [r[0, 2] - r[2, 0], r[1, 0] + r[0, 1], 1 - r[0, 0] + r[1, 1] - r[2, 2], r[2, 1] + r[1, 2]],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[2, 1] + r[1, 2], 1 - r[0, 0] - r[1, 1] + r[2, 2]]]
    row = numpy.array(rows[max(range(4), key=lambda k: rows[k][k])])
    return (row / numpy.linalg.norm(row)).tolist()


def clearance_at(pose):
    """That of the part at a pose, and of a window without width."""
    with tempfile.NamedTemporaryFile("w+", suffix=".json") as result, tempfile.NamedTemporaryFile(
            "w+", suffix=".json") as start:
        found = subprocess.run([lekalo, "locate", "--part", part, "--blank", blank, "--method", "climb", "--shift", "0",
                                "--tilt", "0", "-o", result.name], stderr=subprocess.PIPE, text=True)
        if found.returncode > 1:
            sys.exit(found.stderr)
        written = json.load(open(result.name, encoding="utf-8"))
        written["quaternion"] = quaternion(pose[:3, :3])
        written["x"], written["y"], written["z"] = pose[:3, 3].tolist()
        json.dump(written, start)
        start.flush()
        subprocess.run([lekalo, "locate", "--part", part, "--blank", blank, "--method", "climb", "--shift", "0",
                        "--tilt", "0", "--start", start.name, "-o", result.name], stderr=subprocess.DEVNULL)
        there = json.load(open(result.name, encoding="utf-8"))["clearance"]
        return "cuts in" if there is None else f"clearance {there:.4f} mm"


def icp(source, target, most):
    """Times of one run from reading on, and its result: the vertices of the source to those of the target."""
    clouds = [open3d.geometry.PointCloud(source.vertices), open3d.geometry.PointCloud(target.vertices)]
    clock, processor = time.perf_counter(), time.process_time()
    target.vertex_normals = open3d.utility.Vector3dVector()
    target.triangle_normals = open3d.utility.Vector3dVector()
    target.compute_vertex_normals()
    clouds[1].normals = target.vertex_normals
    found = registration.registration_icp(
        clouds[0], clouds[1], 20.0, estimation_method=registration.TransformationEstimationPointToPlane(),
        criteria=registration.ICPConvergenceCriteria(max_iteration=most))
    return time.perf_counter() - clock, time.process_time() - processor, found


def climb():
    """Times of one climb on two threads, and what it found."""
    told = subprocess.run([bench, "place", part, blank, "2"], capture_output=True, text=True, check=True).stdout.split()
    return float(told[0]), float(told[1]), float(told[4])


meshes = [open3d.io.read_triangle_mesh(name).remove_duplicated_vertices() for name in (part, blank)]
# A scan is matched with the drawing as a rule, whose normals are known; the other way round fewer points are moved.
ways = {"icp of the part to the blank, 30 steps": (meshes, 30), "the same until it settles": (meshes, 1000),
        "icp of the blank to the part, 30 steps": (meshes[::-1], 30), "that until it settles": (meshes[::-1], 1000)}
times = {name: [] for name in [*ways, "climb"]}
for _ in range(runs):
    for name, (pair, most) in ways.items():
        times[name].append(icp(*pair, most))
    times["climb"].append(climb())
points = [len(mesh.vertices) for mesh in meshes]
print(f"{points[0]} and {points[1]} points; the least of {runs} runs, by the clock and in processor time")
for name, each in times.items():
    found = each[0][2]
    if name == "climb":
        said = f"clearance {found:.4f} mm"
    else:
        pose = numpy.asarray(found.transformation)
        pose = pose if ways[name][0] is meshes else numpy.linalg.inv(pose)
        said = f"rms {found.inlier_rmse:.4f} mm, {clearance_at(pose)}"
    print(f"{name}: {min(t[0] for t in each):.3f} s, {min(t[1] for t in each):.3f} s; {said}")
