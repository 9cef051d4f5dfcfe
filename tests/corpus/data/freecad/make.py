"""Has FreeCAD make the programs of this folder: freecadcmd make.py, with FreeCAD 0.20.2 of Debian 12.

Each is a block whose pocket is cleared but for 0.3 mm by a Pocket operation, and finished by a Profile operation that
FreeCAD compensates, post-processed by its own linuxcnc_post. Nothing is changed afterwards. The blocks are ours, and
stand in rectangle.json and ring.json as lekalo reads them.
"""
import importlib
import pathlib

import FreeCAD
import Part
import PathScripts.PathJob as PathJob
import PathScripts.PathPocketShape as PathPocketShape
import PathScripts.PathProfile as PathProfile
import PathScripts.post.linuxcnc_post as post

HERE = pathlib.Path(__file__).resolve().parent
AT = FreeCAD.Vector


def rectangle():
    return Part.makeBox(60, 50, 12, AT(-10, -10, -12)).cut(Part.makeBox(40, 30, 4, AT(0, 0, -4)))


def ring():
    hole = Part.makeCylinder(20, 4, AT(0, 0, -4)).cut(Part.makeCylinder(10, 4, AT(0, 0, -4)))
    return Part.makeBox(60, 50, 12, AT(-30, -25, -12)).cut(hole)


def set_depths(operation, step):
    for name, value in (("StartDepth", 0), ("FinalDepth", -4), ("StepDown", step), ("SafeHeight", 3),
                        ("ClearanceHeight", 5)):
        operation.setExpression(name, None)
        setattr(operation, name, value)


def operations(name, shape, finish_step):
    document = FreeCAD.newDocument(name)
    part = document.addObject("Part::Feature", "Block")
    part.Shape = shape
    document.recompute()
    floor = next(f"Face{i + 1}" for i, face in enumerate(shape.Faces)
                 if abs(face.BoundBox.ZMin + 4) < 1e-6 and abs(face.BoundBox.ZMax + 4) < 1e-6)
    job = PathJob.Create("Job", [part], None)
    job.GeometryTolerance.Value = 0.001
    tool = job.Tools.Group[0]
    tool.Tool.Diameter = 6
    tool.HorizFeed, tool.VertFeed = FreeCAD.Units.Quantity("900 mm/min"), FreeCAD.Units.Quantity("200 mm/min")
    tool.SpindleSpeed = 8000
    pocket = PathPocketShape.Create("Pocket")
    pocket.Base = [(job.Model.Group[0], [floor])]
    pocket.ExtraOffset, pocket.StepOver = 0.3, 60
    pocket.OffsetPattern = "Offset" if name == "ring" else "ZigZagOffset"
    set_depths(pocket, 2)
    profile = PathProfile.Create("Finish")
    profile.Base = [(job.Model.Group[0], [floor])]
    profile.Side, profile.UseComp, profile.processPerimeter = "Inside", True, True
    profile.processHoles = profile.processCircles = name == "ring"
    set_depths(profile, finish_step)
    document.recompute()
    return [tool, pocket, profile]


def write(name, what, *words):
    importlib.reload(post)  # its options are globals
    post.export(what, str(HERE / name), " ".join(("--no-show-editor",) + words))


plain, round_one = operations("rectangle", rectangle(), 4), operations("ring", ring(), 2)
write("rectangle.ngc", plain)
write("rectangle_inch.ngc", plain, "--inches", "--precision", "4")
write("ring.ngc", round_one)
