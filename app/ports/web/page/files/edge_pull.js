// The turn of a camera that brings an edge of the scene from where it is drawn to where the picture
// shows it.
const kDeg = Math.PI / 180;

function vector({ yaw, pitch }) {
  return [Math.sin(yaw * kDeg) * Math.cos(pitch * kDeg), Math.cos(yaw * kDeg) * Math.cos(pitch * kDeg),
          Math.sin(pitch * kDeg)];
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// The smallest turn from one unit vector to another, of vector v.
function turned(v, from, to) {
  const axis = cross(from, to), cosine = dot(from, to), share = dot(axis, v) / (1 + cosine);
  const sideways = cross(axis, v);
  return v.map((part, k) => cosine * part + sideways[k] + share * axis[k]);
}

async function directionAt(camera, [u, v]) {
  const answer = await fetch(`/api/v1/alignment/direction?${new URLSearchParams({ camera, u, v })}`);
  const direction = await answer.json();
  if (!answer.ok) throw new Error(direction.error);
  return vector(direction);
}

// Arguments of turn_camera. What is drawn at one pixel lies where the other one shows it.
export async function turnOfPull(camera, drawn, shown) {
  const [to, from] = await Promise.all([directionAt(camera, drawn), directionAt(camera, shown)]);
  const [right, forward, up] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => turned(axis, from, to));
  return { yaw: Math.atan2(forward[0], forward[1]) / kDeg, pitch: Math.asin(forward[2]) / kDeg,
           roll: Math.atan2(-right[2], up[2]) / kDeg };
}
