// SPDX-License-Identifier: Apache-2.0
// Draws the room as seen from the ball's centre, by WebGL 2, from pictures of balls and the meshes
// of /api/v1/sphere.

const kNear = 0.5, kFar = 2e4; // ball radii
const kNodeBytes = 24;
const kLineColour = [1, 0.86, 0];
const kLineOffsets = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]; // px

const kVertex = `#version 300 es
uniform mat3 axes;  // columns: right, up, forward
uniform vec2 scale, shift;
uniform float nearer;
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 offset;
layout(location = 2) in float resolution;
out highp vec3 place;
out highp vec2 beside;
out highp float sharpness;
void main() {
  vec3 seen = position * axes * nearer;
  const float n = ${kNear.toFixed(1)}, f = ${kFar.toFixed(1)};
  gl_Position = vec4(seen.xy * scale, (seen.z * (f + n) - 2.0 * f * n) / (f - n), seen.z);
  gl_Position.xy += shift * seen.z;
  place = position;
  beside = offset;
  sharpness = resolution;
}`;

const kPicture = `#version 300 es
precision highp float;
uniform sampler2D picture;
uniform vec3 facing, across, down;
uniform vec2 centre, size;
uniform float opacity, heat;
in vec3 place;
in vec2 beside;
in float sharpness;
out vec4 colour;
void main() {
  vec3 half_way = normalize(normalize(place) + facing);
  vec2 pixel = centre + vec2(dot(across, half_way), dot(down, half_way)) + beside;
  // Filtering of the appliance (proc/remap): beyond a step of 1.4 px, the mean of four places in the pixel,
  // read from the mip level below the one whose step is allowed.
  vec2 right = dFdx(pixel), below = dFdy(pixel);
  float smaller = float(textureSize(picture, 0).x) / size.x; // a picture may be sent in another size
  float step = smaller * sqrt(max(dot(right, right), dot(below, below)));
  float level = clamp(ceil(log2(step / 1.4)), 0.0, 3.0);
  vec3 shown = vec3(0);
  if (level == 0.0) {
    shown = textureLod(picture, (pixel + 0.5) / size, 0.0).rgb;
  } else {
    for (int k = 0; k < 4; ++k) {
      vec2 point = pixel + (k < 2 ? 0.25 : -0.25) * right + (k % 2 == 0 ? 0.25 : -0.25) * below;
      shown += 0.25 * textureLod(picture, (point + 0.5) / size, level - 1.0).rgb;
    }
  }
  // Colours from 1 px per degree, blue, over green to 16, red.
  float t = clamp(log2(max(sharpness, 1.0)) / 4.0, 0.0, 1.0);
  vec3 ramp = clamp(vec3(2.0 * t - 1.0, 1.0 - abs(2.0 * t - 1.0), 1.0 - 2.0 * t), 0.0, 1.0);
  colour = vec4(mix(shown, ramp, heat), opacity);
}`;

const kPlain = `#version 300 es
precision highp float;
uniform vec3 plain;
out vec4 colour;
void main() { colour = vec4(plain, 1.0); }`;

const kEverywhere = `#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 1.0, 1.0);
}`;

const kHatch = `#version 300 es
precision highp float;
uniform float pitch;
out vec4 colour;
void main() {
  bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, pitch) < pitch * 0.25;
  colour = vec4(vec3(pitch > 0.0 && stripe ? 0.45 : 0.08), 1.0);
}`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`WebGL: ${gl.getProgramInfoLog(made)}`);
  }
  const at = {};
  const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let k = 0; k < count; ++k) {
    const { name } = gl.getActiveUniform(made, k);
    at[name] = gl.getUniformLocation(made, name);
  }
  return { made, at };
}

// One camera: its mesh and its newest picture.
class Sphere {
  constructor(gl, { head, body }) {
    this.gl = gl;
    this.head = head;
    this.hasPicture = false;
    const indices = head.nodes * kNodeBytes;
    this.room = gl.createVertexArray();
    gl.bindVertexArray(this.room);
    this.buffers = [gl.createBuffer(), gl.createBuffer(), gl.createBuffer()];
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, body.subarray(0, indices), gl.STATIC_DRAW);
    [[3, 0], [2, 12], [1, 20]].forEach(([numbers, offset], place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, numbers, gl.FLOAT, false, kNodeBytes, offset);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers[1]);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, body.subarray(indices), gl.STATIC_DRAW);
    this.lines = gl.createVertexArray();
    gl.bindVertexArray(this.lines);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[2]);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(head.edges.flat()), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    this.texture = gl.createTexture();
  }

  show(picture) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, picture);
    // Used only if a view has a lower resolution than the ball's picture.
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    this.hasPicture = true;
  }

  free() {
    for (const buffer of this.buffers) this.gl.deleteBuffer(buffer);
    this.gl.deleteVertexArray(this.room);
    this.gl.deleteVertexArray(this.lines);
    this.gl.deleteTexture(this.texture);
  }
}

export class SpherePainter {
  #spheres = new Map();

  // Null without WebGL 2.
  static make(canvas) {
    const gl = canvas.getContext("webgl2", { preserveDrawingBuffer: true, alpha: false });
    return gl && new SpherePainter(gl);
  }

  constructor(gl) {
    this.gl = gl;
    this.begin();
  }

  // Also called after a lost context, with which all objects are lost.
  begin() {
    const gl = this.gl;
    this.#spheres.clear();
    this.picture = program(gl, kVertex, kPicture);
    this.plain = program(gl, kVertex, kPlain);
    this.hatch = program(gl, kEverywhere, kHatch);
    this.nothing = gl.createVertexArray();
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Forgets all meshes and pictures.
  clear() {
    for (const sphere of this.#spheres.values()) sphere.free();
    this.#spheres.clear();
  }
  // Forgets the pictures of all others.
  keepPictures(names) {
    for (const [name, sphere] of this.#spheres) if (!names.includes(name)) sphere.hasPicture = false;
  }

  // `mesh`: {head, body} from /api/v1/sphere.
  setMesh(name, mesh) {
    this.#spheres.get(name)?.free();
    this.#spheres.set(name, new Sphere(this.gl, mesh));
  }
  hasMesh(name) {
    return this.#spheres.has(name);
  }
  headOf(name) {
    return this.#spheres.get(name).head;
  }
  // The picture may be smaller than the mesh states.
  show(name, picture) {
    this.#spheres.get(name)?.show(picture);
  }

  // `view`: {axes: 9 numbers, tangent: of half the horizontal field of view}; `shown`: {first,
  // second: names, mix: the second's share, blind, resolution, wireFrame: what is marked}.
  draw(view, shown) {
    const gl = this.gl;
    const { width, height } = gl.canvas;
    gl.viewport(0, 0, width, height);
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
    this.#drawHatch(shown.blind ? Math.max(8, width / 60) : 0);
    gl.enable(gl.DEPTH_TEST);
    const ready = (name) => {
      const sphere = this.#spheres.get(name);
      return sphere?.hasPicture ? sphere : null;
    };
    const first = ready(shown.first), second = ready(shown.second);
    const heat = shown.resolution ? 0.5 : 0;
    // Each camera fills directions that the other does not see.
    for (const sphere of [first, second]) {
      if (!sphere) continue;
      // Background for pixels that fall between small triangles and a large one.
      this.#drawSphere(sphere, view, 1, heat, [0.5, 0.5]);
      this.#drawSphere(sphere, view, 1, heat);
    }
    if (first && second) this.#drawSphere(first, view, 1 - shown.mix, heat);
    if (shown.wireFrame && (first ?? second)) this.#drawLines(first ?? second, view);
    gl.bindVertexArray(null);
  }

  #drawHatch(pitch) {
    const gl = this.gl;
    gl.useProgram(this.hatch.made);
    gl.uniform1f(this.hatch.at.pitch, pitch);
    gl.bindVertexArray(this.nothing);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  #place({ made, at }, view, shift, nearer) {
    const gl = this.gl;
    const { width, height } = gl.canvas;
    gl.useProgram(made);
    gl.uniformMatrix3fv(at.axes, false, view.axes);
    gl.uniform2f(at.scale, 1 / view.tangent, width / height / view.tangent);
    gl.uniform2f(at.shift, (2 * shift[0]) / width, (2 * shift[1]) / height);
    gl.uniform1f(at.nearer, nearer);
  }

  #drawSphere(sphere, view, opacity, heat, shift = [0, 0]) {
    const gl = this.gl;
    const { head } = sphere;
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.bindVertexArray(sphere.room);
    gl.disable(gl.BLEND);
    // The blind cone only hides the background.
    gl.colorMask(false, false, false, false);
    this.#place(this.plain, view, shift, 1);
    gl.drawElements(gl.TRIANGLES, 3 * head.blind, gl.UNSIGNED_INT, 12 * head.triangles);
    gl.colorMask(true, true, true, true);
    if (opacity < 1) gl.enable(gl.BLEND);
    const { at } = this.picture;
    this.#place(this.picture, view, shift, 1);
    gl.bindTexture(gl.TEXTURE_2D, sphere.texture);
    gl.uniform3fv(at.facing, head.facing);
    gl.uniform3fv(at.across, head.u);
    gl.uniform3fv(at.down, head.v);
    gl.uniform2fv(at.centre, head.centre);
    gl.uniform2f(at.size, head.width, head.height);
    gl.uniform1f(at.opacity, opacity);
    gl.uniform1f(at.heat, heat);
    gl.drawElements(gl.TRIANGLES, 3 * head.triangles, gl.UNSIGNED_INT, 0);
    gl.disable(gl.BLEND);
  }

  #drawLines(sphere, view) {
    const gl = this.gl;
    gl.bindVertexArray(sphere.lines);
    for (const shift of kLineOffsets) {
      this.#place(this.plain, view, shift, 0.998);
      gl.uniform3fv(this.plain.at.plain, kLineColour);
      gl.drawArrays(gl.LINES, 0, 2 * sphere.head.edges.length);
    }
  }
}
