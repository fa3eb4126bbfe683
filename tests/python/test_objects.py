# SPDX-License-Identifier: MIT
"""Lives of objects, values, signals, scripts."""

import gc
import os
import pickle
import random
import subprocess
import sys
import threading
import weakref

import numpy
import pytest

import lucent
from lucent import _lucent


def test_values_are_immutable():
    node = lucent.Node3D()
    with pytest.raises(AttributeError, match=r"Vector3 is a value.*with_x.*set_indexed\('property:x'"):
        node.position.x = 1
    node.position += lucent.Vector3(1, 0, 0)
    node.position = node.position.with_y(2)
    node.set_indexed("position:z", 3)
    assert node.position == (1, 2, 3)
    assert node.get_indexed("position:z") == 3
    node.position = numpy.array([4, 5, 6])
    assert numpy.asarray(node.position).dtype == numpy.float32
    assert numpy.asarray(node.transform).shape == (3, 4)
    for value in (node.position, node.transform, lucent.Color("#ff8800"), lucent.NodePath("a/b:c"), lucent.AABB()):
        assert pickle.loads(pickle.dumps(value)) == value
        assert hash(value) == hash(pickle.loads(pickle.dumps(value)))


def test_transforms_multiply_as_godots():
    node, child = lucent.Node3D(), lucent.Node3D()
    node.add_child(child)
    node.position, node.rotation_degrees, child.position = (1, 2, 3), (0, 90, 0), (0, 0, -2)
    assert (node.transform * child.position - child.global_position).length() < 1e-5
    assert numpy.allclose((node.transform * child.transform).origin, child.global_position, atol=1e-5)


def test_orphans_end_with_their_handles():
    before = _lucent.object_count()
    node = lucent.Node()
    node.add_child(lucent.Node3D(name="Child"))
    assert node["Child"] is node.get_child(0)
    child = node["Child"]
    node.remove_child(child)
    del node
    assert lucent.is_instance_valid(child)
    assert child.get_parent() is None
    del child
    assert _lucent.object_count() == before


def test_freed_nodes_raise():
    node = lucent.MeshInstance3D(name="Box")
    node.free()
    assert not lucent.is_instance_valid(node)
    assert repr(node).startswith("<freed MeshInstance3D")
    with pytest.raises(lucent.FreedObjectError, match="MeshInstance3D.* was freed"):
        node.position
    with pytest.raises(ReferenceError):
        node.get_children()


def test_queue_free_lasts_until_the_frame_ends(tree):
    node = lucent.Node()
    tree.root.add_child(node)
    node.queue_free()
    assert lucent.is_instance_valid(node)
    tree.process(0.1)
    assert not lucent.is_instance_valid(node)


def test_resources_outlive_trees():
    with lucent.SceneTree() as tree:
        node = lucent.MeshInstance3D(mesh=lucent.SphereMesh())
        tree.root.add_child(node)
        mesh = node.mesh
    assert mesh.radius == 0.5
    assert not lucent.is_instance_valid(node)


def test_owners_are_checked():
    first, second, child = lucent.Node(), lucent.Node(), lucent.Node(name="Child")
    first.add_child(child)
    with pytest.raises(TypeError, match="already has an owner"):
        second.add_child(child)
    with pytest.raises(lucent.Error, match="below it"):
        child.add_child(first)
    assert lucent.is_instance_valid(first)
    child.reparent(second)
    assert child.get_parent() is second
    with pytest.raises(lucent.NodeNotFoundError, match="did you mean 'Child'"):
        second["Chidl"]
    with pytest.raises(lucent.Error):
        lucent.BoxMesh().free()


def test_search_and_copy():
    root = lucent.Node(name="Root")
    for name in ("Lamp1", "Lamp2", "Table"):
        root.add_child(lucent.Node3D(name=name))
    root["Lamp2"].add_to_group("lamps")
    root["Table"].position = (1, 2, 3)
    assert [node.name for node in root.find_children("Lamp?", owned=False)] == ["Lamp1", "Lamp2"]
    root.move_child(root["Table"], 0)
    assert [node.name for node in root] == ["Table", "Lamp1", "Lamp2"] and len(root) == 3
    copy = root.duplicate()
    assert copy["Lamp2"].get_groups() == ["lamps"] and copy["Table"].position == (1, 2, 3)
    assert str(root["Table"].get_path_to(root["Lamp1"])) == "../Lamp1"


def test_signals():
    heard = []
    node, other = lucent.Node(), lucent.Node()
    node.renamed.connect(lambda: heard.append("attribute"))
    node.connect("child_entered_tree", heard.append)
    node.name = "Other"
    node.add_child(other)
    assert heard == ["attribute", other]
    with pytest.raises(lucent.Error, match="already connected"):
        node.connect("child_entered_tree", heard.append)
    node.child_entered_tree.disconnect(heard.append)
    assert not node.has_connections("child_entered_tree")
    once = lambda: heard.append("once")
    node.renamed.connect(once, lucent.Object.CONNECT_ONE_SHOT)
    node.name, node.name = "A", "B"
    assert heard.count("once") == 1
    with pytest.raises(AttributeError, match="no signal 'thrown'"):
        node.connect("thrown", print)


class Log(lucent.Node3D):
    events = []

    def _enter_tree(self):
        self.events.append(("enter", self.name))

    def _exit_tree(self):
        self.events.append(("exit", self.name))

    def _ready(self):
        self.events.append(("ready", self.name))

    def _process(self, delta):
        self.events.append(("process", delta))

    def shout(self, word):
        return word.upper()


def test_scripts(tree):
    Log.events.clear()
    parent, child = Log(name="Parent"), Log(name="Child")
    parent.add_child(child)
    tree.root.add_child(parent)
    child.set_process(False)
    tree.process(0.25)
    tree.paused = True
    tree.process(0.25)
    tree.paused = False
    tree.root.remove_child(parent)
    assert Log.events == [
        ("enter", "Parent"),
        ("enter", "Child"),
        ("ready", "Child"),
        ("ready", "Parent"),
        ("process", 0.25),
        ("exit", "Child"),
        ("exit", "Parent"),
    ]
    assert parent.call("shout", "a") == "A" and parent.has_method("shout")
    assert type(parent.duplicate()) is Log


def test_a_dropped_half_goes_on(tree):
    Log.events.clear()
    node = Log()
    node.mine = 5
    tree.root.add_child(node)
    identity = id(node)
    del node
    gc.collect()
    tree.process(0.5)
    assert ("process", 0.5) in Log.events
    assert tree.root.get_child(0).mine == 5 and id(tree.root.get_child(0)) == identity


def test_cycles_are_collected():
    class Holder(lucent.Node):
        def __init__(self, tree):
            super().__init__()
            self.tree = tree
            self.ready.connect(self.hear)

        def hear(self):
            pass

    gc.collect()
    before = _lucent.object_count()
    tree = lucent.SceneTree()
    tree.root.add_child(Holder(tree))
    gone = weakref.ref(tree)
    del tree
    gc.collect()
    assert gone() is None
    assert _lucent.object_count() == before


def test_attaching(tree, root):
    tree.current_scene = lucent.Node3D(name="Main")
    tree.current_scene.add_child(lucent.MeshInstance3D(name="Door"))
    tree.current_scene["Door"].add_to_group("Doors")

    class Door(lucent.MeshInstance3D):
        opened = 0.0

        def _ready(self):
            self.opened = 1.0

    door = tree.attach("Door", Door)
    assert door.opened == 1.0 and tree.current_scene["Door"] is door
    with pytest.raises(TypeError, match="expected a Python subclass"):
        tree.attach("Door", type("Lamp", (lucent.OmniLight3D,), {}))


def test_new_attributes_that_look_like_typos_raise():
    class Mine(lucent.Node3D):
        def __init__(self):
            super().__init__()
            self.counter = 1

    node = Mine()
    node.counter += 1
    with pytest.raises(AttributeError, match="did you mean 'position'"):
        node.positon = (1, 2, 3)


@pytest.mark.parametrize("name", ["_enter_tree", "_ready", "_process", "_exit_tree", "_notification"])
def test_callbacks_raise_with_their_traceback(tree, name):
    raised = []

    def fail(self, *_):
        if not raised:  # the tree's end, which notifies too, has nothing to raise
            raised.append(name)
            raise KeyError("mine")

    node = type("Failing", (lucent.Node,), {name: fail})()
    with pytest.raises(KeyError, match="mine") as caught:
        tree.root.add_child(node)
        tree.process(0.1)
        tree.root.remove_child(node)
    assert caught.traceback[-1].name == "fail"
    tree.process(0.1) if name not in ("_process", "_notification") else None
    assert tree.root.get_child_count() in (0, 1)


def test_handlers_raise(tree):
    node = lucent.Node()
    node.renamed.connect(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        node.name = "A"
    assert node.name == "A"


def test_random_lives(tree):
    generator = random.Random(7)
    nodes = [lucent.Node3D() for _ in range(20)]
    allowed = (lucent.Error, TypeError, ValueError)
    for step in range(10000):
        node, other = generator.choice(nodes), generator.choice(nodes)
        try:
            action = generator.randrange(9)
            if action == 0:
                node.add_child(other)
            elif action == 1:
                tree.root.add_child(node)
            elif action == 2 and node.get_parent():
                node.get_parent().remove_child(node)
            elif action == 3:
                node.free() if generator.random() < 0.5 else node.queue_free()
            elif action == 4:
                nodes[nodes.index(node)] = Log() if generator.random() < 0.3 else lucent.Node3D()
            elif action == 5:
                node.visibility_changed.connect(other.hide)
            elif action == 6:
                node.visible = not node.visible
            elif action == 7:
                node.reparent(other)
            elif step % 50 == 0:
                tree.process(0.01)
        except allowed:
            pass
    Log.events.clear()


def test_threads_take_turns(tree):
    nodes = [lucent.Node3D() for _ in range(4)]
    for node in nodes:
        tree.root.add_child(node)
    stop, failures = threading.Event(), []

    def work(node):
        try:
            while not stop.is_set():
                node.position += (1, 0, 0)
                node.add_child(lucent.Node())
                node.remove_child(node.get_child(0))
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=work, args=(node,)) for node in nodes]
    for thread in threads:
        thread.start()
    for _ in range(100):
        tree.process(0.01)
    stop.set()
    for thread in threads:
        thread.join(20)
    assert not failures and not any(thread.is_alive() for thread in threads)


def test_forks_are_refused():
    child = os.fork()
    if child == 0:
        try:
            lucent.Node()
        except lucent.DeviceError as error:
            os._exit(0 if "spawn" in str(error) else 2)
        os._exit(1)
    assert os.waitpid(child, 0)[1] == 0


def test_nodes_do_not_pickle():
    with pytest.raises(TypeError, match="save the scene, or send its path"):
        pickle.dumps(lucent.Node())


def test_import_is_quick_and_opens_no_device():
    # CPU time: other programs' share of the machine does not count.
    code = "import time, numpy; t = time.process_time(); import lucent; print(time.process_time() - t)"
    environment = dict(os.environ, VK_DRIVER_FILES="/nowhere", VK_ICD_FILENAMES="/nowhere")
    run = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True) for _ in range(3)]
    assert min(float(result.stdout) for result in run) < 0.3


def test_loading_errors(tmp_path):
    broken = tmp_path / "broken.tscn"
    broken.write_text("[gd_scene format=3]\n\n[node name=\"A\" type=\"Node3D\"]\nposition = Vector3(1,\n")
    with pytest.raises(lucent.LoadError, match=r"broken.tscn:\d"):
        lucent.open(broken)
    with pytest.raises(lucent.LoadError, match="there is no such file"):
        lucent.load("nothing.tscn")
