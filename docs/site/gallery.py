"""Models of the repository with pictures of their deformed meshes; tools/site calls `write`."""
import itertools
import pathlib
import tempfile

# A model, and how far its analysis has come in the picture (1: the end).
MODELS = [("examples/sliding_block/sliding_block.yaml", 1), ("examples/ball_dragged/ball_dragged.yaml", 1),
          ("examples/dent/dent.yaml", 0.6), ("examples/clip/clip.yaml", 0.5), ("examples/crossed_beams/crossed_beams.yaml", 1),
          ("examples/block3d/block3d.yaml", 1), ("examples/bolted_joint/joint.inp", 1)]
MODELS += [(f"verification/hard_problems/{name}.yaml", part) for name, part in [
    ("snap_fit", 0.3), ("belt_on_pulley", 1), ("asperities", 0.4), ("pile", 1), ("buckling_strip", 1), ("pressed_arch", 1),
    ("into_a_funnel", 1), ("rubber_in_corner", 1), ("strip_pulled_out", 1), ("beam_on_rollers", 1), ("twisted", 1),
    ("press_fit", 1)]]
MODELS += [("verification/plastic_necking/bar.yaml", 1)]


def texts(file):
    """Title of a model, and the comment its file begins with; of a deck its heading, cut at the colon."""
    lines = file.read_text().split("\n")
    if lines[0].lower() == "*heading":
        title, _, comment = lines[1].partition(": ")
        return title, comment
    title = next(line.removeprefix("title: ") for line in lines if line.startswith("title: "))
    comment = itertools.takewhile(lambda line: line.startswith("#"), lines)
    return title, " ".join(line.strip("# ") for line in comment)


def write(root, folder, say=print):
    """Runs all models into a folder of its own and writes gallery.md with its pictures."""
    import osculate
    from matplotlib import pyplot

    pyplot.switch_backend("agg")
    page = ["# Gallery", "", f"{len(MODELS)} models of the repository, run when this site was built: the deformed mesh,",
            "coloured by von Mises stress from its least value to its greatest, and rigid bodies as red lines.", ""]
    for path, part in MODELS:
        name = pathlib.Path(path).stem
        with tempfile.TemporaryDirectory() as results:
            result = osculate.run(str(root / path), folder=results)
            drawn = [i for i in result.increments if i.has_fields]
            axes = drawn[round(part * (len(drawn) - 1))].plot(file=folder / f"{name}.png")
            pyplot.close(axes.figure)
            title, comment = texts(root / path)
            page += [f"## {title}", "", f"![{title}]({name}.png)", "",
                     f"{comment} ([{pathlib.Path(path).name}](../{path}))", ""]
        say(f"gallery: {path}")
    (folder / "gallery.md").write_text("\n".join(page))
