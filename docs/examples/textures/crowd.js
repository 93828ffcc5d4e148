// SPDX-License-Identifier: Apache-2.0
// People whom vertex animation textures bend: for each member of the cast one mesh, drawn once for everybody who is
// that member. Reads OpenEXR (--texture float or half): browsers read no PNG of 16 bits.
import * as THREE from "three";
import {EXRLoader} from "three/addons/loaders/EXRLoader.js";
import {GLTFLoader} from "three/addons/loaders/GLTFLoader.js";

// What of a person is in the table, as attributes of its instance.
const ATTRIBUTES = {placeHeading: 4, topSize: 4, clips: 4, shares: 4};
const TURN = 65536;

// Replaces where three.js has vertices and normals.
const HEAD = `
uniform highp sampler2D positions, normals;
uniform ivec2 shape;            // columns, rows of a key
uniform ivec2 spans[CLIPS];     // of clips: the first key, how many
attribute vec4 placeHeading;    // m, rad
attribute vec4 topSize;         // the top's colour, how large
attribute vec4 clips;           // numbers of walk, before, stand; 1: is there
attribute vec4 shares;          // phase, stand_phase, left, walking
attribute vec2 uv1;
struct Bent {vec3 place, looks;};
Bent keyOf(ivec2 pixel, int key) {
    pixel.y += key * shape.y;
    return Bent(texelFetch(positions, pixel, 0).xyz, texelFetch(normals, pixel, 0).xyz);
}
Bent mixed(Bent one, Bent other, float share) {
    return Bent(mix(one.place, other.place, share), mix(one.looks, other.looks, share));
}
Bent clipOf(ivec2 pixel, float number, float phase) {
    ivec2 span = spans[int(number + 0.5)];
    float place = fract(phase) * float(span.y);
    int key = int(place) % span.y;
    return mixed(keyOf(pixel, span.x + key), keyOf(pixel, span.x + (key + 1) % span.y), fract(place));
}
Bent bent() {
    ivec2 pixel = ivec2(uv1 * vec2(shape));
    Bent walk = clipOf(pixel, clips.x, shares.x);
    if (shares.z > 0.0) walk = mixed(walk, clipOf(pixel, clips.y, shares.x), shares.z);
    if (shares.w < 1.0) walk = mixed(clipOf(pixel, clips.z, shares.y), walk, shares.w);
    float c = cos(placeHeading.w), s = sin(placeHeading.w);
    mat3 turn = mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
    walk.place = placeHeading.xyz + turn * walk.place * topSize.w * clips.w;
    walk.looks = turn * walk.looks;
    return walk;
}
`;
const BODY = {
    "#include <color_vertex>": "vColor = vec4(mix(topSize.rgb, color.rgb, color.a), 1.0);",
    "#include <beginnormal_vertex>": "vec3 objectNormal = normalize(bent().looks);",
    "#include <begin_vertex>": "vec3 transformed = bent().place;",
};

function patched(material, uniforms, clips) {
    material.onBeforeCompile = shader => {
        Object.assign(shader.uniforms, uniforms);
        let text = shader.vertexShader;
        for (const [place, code] of Object.entries(BODY)) text = text.replace(place, code);
        shader.vertexShader = HEAD.replace("CLIPS", clips) + text;
    };
    return material;
}

/** One texture of all clips' keys, in the order of the table. EXRLoader has the last line first. */
function stacked(images) {
    const width = images[0].width, height = images.reduce((sum, each) => sum + each.height, 0);
    const values = new images[0].data.constructor(4 * width * height);
    let line = 0;
    for (const {data, height: lines} of images)
        for (let from = lines - 1; from >= 0; --from)
            values.set(data.subarray(4 * width * from, 4 * width * (from + 1)), 4 * width * line++);
    const type = values instanceof Float32Array ? THREE.FloatType : THREE.HalfFloatType;
    const texture = new THREE.DataTexture(values, width, height, THREE.RGBAFormat, type);
    texture.needsUpdate = true;
    return texture;
}

async function texturesOf(folder, told, number, kind) {
    const loader = new EXRLoader().setDataType(told.textures.kind === "half" ? THREE.HalfFloatType : THREE.FloatType);
    const files = told.textures.members[number].clips;
    return stacked(await Promise.all(told.clips.map(async clip =>
        (await loader.loadAsync(`${folder}/${files[clip.name][kind]}`)).image)));
}

/** A member's mesh for `count` people. */
async function memberOf(folder, told, {member, file}, count) {
    const layout = told.textures.members[member];
    let key = 0;
    const spans = new Int32Array(told.clips.flatMap(({keys}) => [(key += keys) - keys, keys]));
    const uniforms = {
        positions: {value: await texturesOf(folder, told, member, "position")},
        normals: {value: await texturesOf(folder, told, member, "normal")},
        shape: {value: new THREE.Vector2(layout.width, layout.rows)}, spans: {value: spans}};
    const gltf = await new GLTFLoader().loadAsync(`${folder}/${file}`), geometry = new THREE.InstancedBufferGeometry();
    gltf.scene.traverse(node => node.isMesh && geometry.copy(node.geometry));
    geometry.instanceCount = count;
    for (const [name, size] of Object.entries(ATTRIBUTES))
        geometry.setAttribute(name, new THREE.InstancedBufferAttribute(new Float32Array(size * count), size));
    const mesh = new THREE.Mesh(geometry, patched(
        new THREE.MeshStandardMaterial({roughness: 0.8, vertexColors: true}), uniforms, told.clips.length));
    mesh.customDepthMaterial = patched(new THREE.MeshDepthMaterial(), uniforms, told.clips.length);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    return mesh;
}

async function surroundingsOf(folder, told) {
    if (!told.surroundings) return null;
    const gltf = await new GLTFLoader().loadAsync(`${folder}/${told.surroundings}`);
    gltf.scene.traverse(node => node.receiveShadow = node.castShadow = Boolean(node.isMesh));
    gltf.mixer = new THREE.AnimationMixer(gltf.scene);
    for (const each of gltf.animations) gltf.mixer.clipAction(each).play();
    return gltf;
}

/** What is in a record of crowd.bin. */
class Records {
    constructor(bytes, told) {
        this.view = new DataView(bytes);
        this.people = told.people.length;
        this.size = told.records.bytes;
        this.fields = Object.fromEntries(told.records.fields.map(field => [field.name, field]));
    }
    read(frame, person, name, number = 0) {
        const {offset, type} = this.fields[name], at = (frame * this.people + person) * this.size + offset;
        if (type === "float32") return this.view.getFloat32(at + 4 * number, true);
        return type === "uint16" ? this.view.getUint16(at, true) : this.view.getUint8(at);
    }
    /** Of who is there in both frames, with the same clips; turns go the shorter way. */
    between(frame, person, name, share, number = 0) {
        const here = this.read(frame, person, name, number);
        const stays = each => this.read(frame, person, each) === this.read(frame + 1, person, each);
        if (!share || !this.read(frame + 1, person, "there") || !["walk", "before", "stand"].every(stays)) return here;
        const change = this.read(frame + 1, person, name, number) - here;
        const turns = this.fields[name].type === "uint16";
        return here + share * (turns ? (change + 1.5 * TURN) % TURN - TURN / 2 : change);
    }
}

class Crowd extends THREE.Group {
    constructor(told, records, meshes, surroundings) {
        super();
        Object.assign(this, {told, records, meshes, surroundings});
        this.add(...meshes.values());
        if (surroundings) this.add(surroundings.scene);
        this.place = told.people.map(({member}) => {  // of each person in its member's mesh
            const mesh = meshes.get(member);
            mesh.userData.people = (mesh.userData.people ?? 0) + 1;
            return mesh.userData.people - 1;
        });
    }
    get seconds() {
        return (this.told.frames - 1) / this.told.fps;
    }
    /** Where people are in the first frame, on average. */
    get middle() {
        const sum = new THREE.Vector3();
        let count = 0;
        for (let person = 0; person < this.records.people; ++person)
            if (this.records.read(0, person, "there") && ++count)
                sum.add(new THREE.Vector3(...[0, 1, 2].map(axis => this.records.read(0, person, "place", axis))));
        return sum.divideScalar(Math.max(count, 1));
    }
    show(seconds) {
        const at = Math.min(Math.max(seconds, 0), this.seconds) * this.told.fps;
        const frame = Math.floor(at + 1e-4), share = Math.max(frame + 1 < this.told.frames ? at - frame : 0, 0);
        this.told.people.forEach((person, number) => this.pose(person, number, frame, share));
        for (const mesh of this.meshes.values())
            for (const name of Object.keys(ATTRIBUTES)) mesh.geometry.attributes[name].needsUpdate = true;
        this.surroundings?.mixer.setTime(at / this.told.fps);
    }
    pose({member, top, size}, number, frame, share) {
        const {attributes} = this.meshes.get(member).geometry, place = this.place[number];
        const now = (name, axis) => this.records.between(frame, number, name, share, axis);
        const told = name => this.records.read(frame, number, name);
        attributes.placeHeading.setXYZW(place, now("place", 0), now("place", 1), now("place", 2),
                                        now("heading") / TURN * 2 * Math.PI);
        attributes.topSize.setXYZW(place, ...top, size);
        attributes.clips.setXYZW(place, told("walk"), told("before"), told("stand"), told("there"));
        attributes.shares.setXYZW(place, now("phase") / TURN, now("stand_phase") / TURN, now("left") / 255,
                                  now("walking") / 255);
    }
}

export async function loadCrowd(folder) {
    const told = await (await fetch(`${folder}/crowd.json`)).json();
    const records = new Records(await (await fetch(`${folder}/${told.records.file}`)).arrayBuffer(), told);
    const counts = member => told.people.filter(person => person.member === member).length;
    const meshes = new Map(await Promise.all(told.members.map(async each =>
        [each.member, await memberOf(folder, told, each, counts(each.member))])));
    return new Crowd(told, records, meshes, await surroundingsOf(folder, told));
}
