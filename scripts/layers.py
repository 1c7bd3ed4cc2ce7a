"""The layers as the add_layer lines of CMakeLists.txt name them: for check-layers and quick-test."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYER = re.compile(r"^ *add_layer\((\w+) FOLDER (\S+?)(?: PUBLIC (\S+?))?(?: USES ([\w ]+?))?(?: LIBRARIES [^)]*)?\)", re.M)


def read_layers(text=None):
    """Folders of each layer, from the root of the tree, and the layers that each one sees, itself included."""
    folders, sees = {}, {}
    for name, folder, public, uses in LAYER.findall(text or (ROOT / "CMakeLists.txt").read_text()):
        folders[name] = [folder, *([public] if public else [])]
        sees[name] = {name}.union(*(sees[used] for used in uses.split())) if uses else {name}
    return folders, sees
