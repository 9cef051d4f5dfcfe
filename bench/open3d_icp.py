#!/usr/bin/env python3
"""A placement without a bound beside the point-to-plane ICP of Open3D (Debian: python3-open3d), on the same files.

    bench/open3d_icp.py LEKALO PART BLANK

Both are given what they read; times are processor time after reading. The pose of Open3D is put before nobody: it does
not say where material is.
"""
import json
import resource
import subprocess
import sys
import tempfile
import time

import open3d

lekalo, part, blank = sys.argv[1:]
source = open3d.io.read_triangle_mesh(part).remove_duplicated_vertices()
target = open3d.io.read_triangle_mesh(blank).remove_duplicated_vertices()
start = time.process_time()
target.compute_vertex_normals()
clouds = [open3d.geometry.PointCloud(mesh.vertices) for mesh in (source, target)]
clouds[1].normals = target.vertex_normals
registration = open3d.pipelines.registration
found = registration.registration_icp(clouds[0], clouds[1], 20.0,
                                      estimation_method=registration.TransformationEstimationPointToPlane())
rival = time.process_time() - start
with tempfile.NamedTemporaryFile(suffix=".json") as result:
    subprocess.run([lekalo, "locate", "--part", part, "--blank", blank, "--method", "climb", "-o", result.name],
                   stderr=subprocess.DEVNULL, check=True)
    ours = json.load(open(result.name, encoding="utf-8"))
used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
print(f"open3d icp: {rival:.2f} s of {len(clouds[0].points)} and {len(clouds[1].points)} points, rms "
      f"{found.inlier_rmse:.4f} mm")
print(f"lekalo climb: {ours['run']['seconds']:.2f} s by the clock; {used:.2f} s of processor time with reading, "
      f"checking and writing; clearance {ours['clearance']:.4f} mm")
