# SPDX-License-Identifier: Apache-2.0
"""Shows a .glb in three.js, in a headless Chromium: an engine that is not ours."""
import contextlib
import json
import os
import pathlib

import pytest

from conftest import ROOT, chromium

MODULES = pathlib.Path(os.environ.get("THRONG_NODE_MODULES", ROOT / "build" / "node" / "node_modules"))
TEXTURES = ROOT / "docs" / "examples" / "textures"
PAGE = """
<!doctype html><meta charset="utf-8"><style>body {margin: 0}</style>
<script type="importmap">{"imports": {"three": "/three/build/three.module.js",
                                      "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import {GLTFLoader} from "three/addons/loaders/GLTFLoader.js";
import {MeshoptDecoder} from "three/addons/libs/meshopt_decoder.module.js";
const renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
renderer.setSize(innerWidth, innerHeight);
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(35, innerWidth / innerHeight, 0.1, 400);
scene.background = new THREE.Color(0xb4c4d2);
scene.add(new THREE.HemisphereLight(0xdfe8f2, 0x7c766c, 1.6));
const sun = new THREE.DirectionalLight(0xfff1dc, 3);
sun.position.set(-14, 48, 26);
sun.castShadow = true;
sun.shadow.mapSize.set(4096, 4096);
sun.shadow.bias = -0.001;
sun.shadow.normalBias = 0.06;
Object.assign(sun.shadow.camera, {left: -40, right: 40, top: 40, bottom: -40, far: 140});
scene.add(sun);
const loader = new GLTFLoader();
loader.setMeshoptDecoder(MeshoptDecoder);
let gltf, mixer;
window.load = async name => {
    gltf = await loader.loadAsync("/files/" + name);
    scene.add(gltf.scene);
    gltf.scene.traverse(node => {
        node.frustumCulled = false;
        node.castShadow = node.receiveShadow = Boolean(node.isMesh);
    });
    mixer = new THREE.AnimationMixer(gltf.scene);
    for (const each of gltf.animations) mixer.clipAction(each).play();
    return gltf.animations.map(each => each.name);
};
window.look = (from, to) => {
    camera.position.set(...from);
    camera.lookAt(...to);
    sun.position.add(sun.target.position.set(...to));
    scene.add(sun.target);
};
window.at = seconds => {
    mixer.setTime(seconds);
    gltf.scene.updateMatrixWorld(true);
};
window.draw = () => {
    renderer.render(scene, camera);
    return renderer.info.render.triangles;
};
window.points = name => {  // of the meshes of a node, in the world
    const found = [], at = new THREE.Vector3();
    gltf.scene.getObjectByName(name).traverse(node => {
        if (!node.isSkinnedMesh) return;
        for (let i = 0; i < node.geometry.attributes.position.count; ++i) {
            node.getVertexPosition(i, at);
            found.push(at.applyMatrix4(node.matrixWorld).toArray());
        }
    });
    return found;
};
window.instances = () => {  // the places of the nodes' instances, in the world
    const found = [], place = new THREE.Matrix4();
    gltf.scene.traverse(node => {
        for (let i = 0; node.isInstancedMesh && i < node.count; ++i) {
            node.getMatrixAt(i, place);
            found.push(place.premultiply(node.matrixWorld).toArray());
        }
    });
    return found;
};
window.ready = true;
</script>
"""


def need_three(modules: pathlib.Path) -> None:
    if not (modules / "three").is_dir():
        pytest.skip("the npm package three is not installed")
    if not chromium():
        pytest.skip("no Chromium here")


@contextlib.contextmanager
def opened(playwright, answer, address, size):
    """A page in Chromium, whose requests answer(route, path) answers; `wrong` has what the browser complains of."""
    with playwright.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=chromium(), args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        page.set_default_timeout(120_000)  # on busy machines
        page.wrong = []
        page.on("console", lambda said: page.wrong.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: page.wrong.append(str(error)))
        page.route("**/*", lambda route: answer(route, route.request.url.partition("://")[2].partition("?")[0]))
        page.goto(address)
        yield page
        browser.close()


def answer_file(route, path: pathlib.Path):
    kinds = {".html": "text/html", ".js": "text/javascript", ".json": "application/json"}
    route.fulfill(path=path, content_type=kinds.get(path.suffix, "application/octet-stream"))


@contextlib.contextmanager
def page_of(playwright, files: dict[str, pathlib.Path], modules: pathlib.Path, size=(320, 200)):
    """A page with three.js that answers load(file), at(seconds), look(from, to), draw(), points(node), instances()."""
    def answer(route, path):
        path = path.removeprefix("throng.test")
        if path == "/":
            return route.fulfill(content_type="text/html", body=PAGE)
        if path.startswith("/files/"):
            return answer_file(route, files[path[7:]])
        if path.startswith("/three/"):
            return answer_file(route, modules / path[1:])
        return route.fulfill(status=404)

    with opened(playwright, answer, "http://throng.test/", size) as page:
        page.wait_for_function("window.ready === true", timeout=120_000)
        yield page


@contextlib.contextmanager
def textures_page(playwright, folder: pathlib.Path, modules: pathlib.Path, size=(320, 200)):
    """The page of docs/examples/textures, which shows a folder of vertex animation textures: `crowd` in it has
    look(from, to) and draw(seconds)."""
    def answer(route, path):
        path = path.removeprefix("throng.test/")
        if path.startswith("node_modules/"):
            return answer_file(route, modules / path.removeprefix("node_modules/"))
        if path.startswith("files/"):
            return answer_file(route, folder / path[6:])
        return answer_file(route, TEXTURES / path) if path else route.fulfill(status=404)

    with opened(playwright, answer, "http://throng.test/index.html?crowd=files&at=0", size) as page:
        page.wait_for_function("window.crowd !== undefined", timeout=120_000)
        yield page


def call(page, function, *arguments):
    return page.evaluate(f"window.{function}(...{json.dumps(arguments)})")
