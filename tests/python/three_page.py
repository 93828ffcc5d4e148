# SPDX-License-Identifier: Apache-2.0
"""Shows a .glb in three.js, in a headless Chromium: an engine that is not ours."""
import contextlib
import json
import pathlib

import pytest

from conftest import chromium

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
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.1, 400);
scene.background = new THREE.Color(0xb4c4d2);
scene.add(new THREE.HemisphereLight(0xdfe8f2, 0x7c766c, 1.6));
const sun = new THREE.DirectionalLight(0xfff1dc, 3);
sun.position.set(14, 22, 10);
sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
sun.shadow.normalBias = 0.03;
Object.assign(sun.shadow.camera, {left: -16, right: 16, top: 16, bottom: -16, far: 80});
scene.add(sun);
const loader = new GLTFLoader();
loader.setMeshoptDecoder(MeshoptDecoder);
let gltf, mixer;
window.load = async name => {
    gltf = await loader.loadAsync("/files/" + name);
    scene.add(gltf.scene);
    gltf.scene.traverse(node => {
        node.frustumCulled = false;
        node.castShadow = Boolean(node.isSkinnedMesh || node.isInstancedMesh);
        node.receiveShadow = Boolean(node.isMesh);
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
def page_of(playwright, files: dict[str, pathlib.Path], modules: pathlib.Path, size=(320, 200)):
    """A page with three.js that answers load(file), at(seconds), look(from, to), draw(), points(node), instances()."""
    def answer(route):
        path = route.request.url.partition("//throng.test")[2]
        if path == "/":
            return route.fulfill(content_type="text/html", body=PAGE)
        if path.startswith("/files/"):
            return route.fulfill(path=files[path[7:]], content_type="application/octet-stream")
        if path.startswith("/three/"):
            return route.fulfill(path=modules / path[1:], content_type="text/javascript")
        return route.fulfill(status=404)

    with playwright.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=chromium(), args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        page.wrong = []
        page.on("console", lambda said: page.wrong.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: page.wrong.append(str(error)))
        page.route("**/*", answer)
        page.goto("http://throng.test/")
        page.wait_for_function("window.ready === true", timeout=60_000)
        yield page
        browser.close()


def call(page, function, *arguments):
    return page.evaluate(f"window.{function}(...{json.dumps(arguments)})")
