// The map so far: clouds of points, of which as many are drawn as the computer can in time.
import { kPerMetre } from "./stream.js";

export const kLidarColours = ["#0a7cff", "#ff7a00", "#00a651", "#d400c8", "#00b3b3", "#b58900", "#7f5fff", "#e0004d"];

const kVertex = `
  uniform int mode; uniform float low, high, size, shade, lift; uniform vec3 colours[8];
  attribute float reflectivity, lidar;
  varying vec3 colour;
  vec3 ramp(float s) {  // blue, green, yellow, red
    return clamp(vec3(1.5 - abs(4.0 * s - 3.3), 1.4 - abs(4.0 * s - 2.0), 1.5 - abs(4.0 * s - 0.7)), 0.0, 1.0);
  }
  void main() {
    vec4 in_world = modelMatrix * vec4(position, 1.0);
    if (mode == 2) { for (int i = 0; i < 8; ++i) if (float(i) == mod(lidar, 8.0)) colour = colours[i]; }
    else {
      float s = mode == 0 ? (in_world.z - low) / max(high - low, 0.5) : sqrt(reflectivity);
      colour = lift + shade * ramp(clamp(s, 0.0, 1.0));
    }
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = size;
  }`;
const kFragment = "varying vec3 colour; void main() { gl_FragColor = vec4(colour, 1.0); }";

const kSize = 2, kLargest = 4;  // pixels
const kNear = 20;  // m
export const kColourModes = ["height", "reflectivity", "lidar"];

export function pointMaterial(size, mode) {
  return new THREE.ShaderMaterial({
    uniforms: { mode: { value: kColourModes.indexOf(mode) }, low: { value: 0 }, high: { value: 10 },
                size: { value: size }, shade: { value: 1 }, lift: { value: 0 },
                colours: { value: kLidarColours.map((colour) => new THREE.Color(colour)) } },
    vertexShader: kVertex, fragmentShader: kFragment });
}

export function pointCloud(points, origin, material) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points.cm, 3));
  geometry.setAttribute("reflectivity", new THREE.BufferAttribute(points.reflectivity, 1, true));
  geometry.setAttribute("lidar", new THREE.BufferAttribute(points.lidar, 1));
  geometry.computeBoundingSphere();
  const cloud = new THREE.Points(geometry, material);
  cloud.position.set(...origin);
  cloud.scale.setScalar(1 / kPerMetre);
  return cloud;
}

/** The clouds of the server's messages. Each comes in random order: its first points are a fair sample of it. */
export class MapClouds extends THREE.Group {
  constructor() {
    super();
    this.material = pointMaterial(kSize, "height");
    this.points = this.drawn = 0;
  }

  /** Yellow is darker on white, and blue lighter on black. */
  setTheme(theme) {
    this.material.uniforms.shade.value = theme === "dark" ? 0.8 : 0.72;
    this.material.uniforms.lift.value = theme === "dark" ? 0.2 : 0;
  }

  append(points, origin) {
    if (points.count === 0) return;
    const cloud = pointCloud(points, origin, this.material);
    cloud.updateMatrixWorld();
    cloud.matrixAutoUpdate = false;
    cloud.sphere = cloud.geometry.boundingSphere.clone().applyMatrix4(cloud.matrixWorld);
    this.add(cloud);
    this.points += points.count;
    this.heights_old = true;
  }

  clear() {
    for (const cloud of this.children) cloud.geometry.dispose();
    this.remove(...this.children);
    this.points = 0;
  }

  /** Has at most about `most` points drawn of those that the camera may see; the nearer, the more of them. */
  thin(camera, most) {
    const seen = this.seenBy(camera);
    const drawn = ({ weight, count }, share) => Math.ceil(Math.min(1, share * weight) * count);
    const sum = (share) => seen.reduce((total, part) => total + drawn(part, share), 0);
    const all = sum(Infinity);
    let share = Infinity;
    if (all > most) {
      let low = 0, high = 1;
      while (sum(high) < most) high *= 2;
      for (let i = 0; i < 12; ++i) {
        share = (low + high) / 2;
        if (sum(share) > most) high = share; else low = share;
      }
    }
    for (const part of seen) part.cloud.geometry.setDrawRange(0, drawn(part, share));
    this.drawn = sum(share);
    // Fewer points are larger ones, so that a stem stays a stem.
    this.material.uniforms.size.value = Math.min(kLargest, kSize * Math.sqrt(all / Math.max(1, this.drawn)));
    return this.drawn < all;
  }

  /** On the screen a cloud is as dense as its distance is far, squared: far ones are thinned first. */
  seenBy(camera) {
    const matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const frustum = new THREE.Frustum().setFromMatrix(matrix), seen = [];
    for (const cloud of this.children) {
      if (!frustum.intersectsSphere(cloud.sphere)) continue;
      const distance = Math.max(kNear, cloud.sphere.center.distanceTo(camera.position));
      seen.push({ cloud, count: cloud.geometry.attributes.position.count, weight: (kNear / distance) ** 2 });
    }
    return seen;
  }

  /** Most of the points have a colour of their own: a few very high ones do not make all others alike. */
  measureHeights() {
    if (!this.heights_old || this.points === 0) return;
    this.heights_old = false;
    const heights = [], step = Math.max(1, Math.floor(this.points / 2000));
    for (const cloud of this.children) {
      const { array, count } = cloud.geometry.attributes.position;
      for (let i = 0; i < count; i += step) heights.push(cloud.position.z + array[3 * i + 2] / kPerMetre);
    }
    heights.sort((a, b) => a - b);
    const at = (share) => heights[Math.floor(share * (heights.length - 1))];
    this.material.uniforms.low.value = at(0.02);
    this.material.uniforms.high.value = at(0.98);
  }
}
