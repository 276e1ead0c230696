// Triangles of surfaces from the answer's bytes, and what a plane cuts out of them.
import type { Mesh } from "../data/answers";

export interface Triangles {
  id: string;
  vertices: Float32Array;
  triangles: Uint32Array;
}

function bytesOf(base64: string): ArrayBuffer {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes.buffer;
}

export function trianglesOf(mesh: Mesh): Triangles {
  return { id: mesh.id, vertices: new Float32Array(bytesOf(mesh.vertices)), triangles: new Uint32Array(bytesOf(mesh.triangles)) };
}

/** Where the plane coordinate[axis] = at meets the triangles: pairs of places, three numbers each. */
export function cut(mesh: Triangles, axis: number, at: number): number[] {
  const { vertices, triangles } = mesh;
  const segments: number[] = [];
  const value = (corner: number, k: number): number => vertices[3 * corner + k] ?? 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const ends: number[] = [];
    for (let k = 0; k < 3; ++k) {
      const a = triangles[t + k] ?? 0;
      const b = triangles[t + ((k + 1) % 3)] ?? 0;
      const [from, to] = [value(a, axis) - at, value(b, axis) - at];
      if (from < 0 === to < 0) continue;
      const part = from / (from - to);
      for (let c = 0; c < 3; ++c) ends.push(value(a, c) + part * (value(b, c) - value(a, c)));
    }
    if (ends.length === 6) segments.push(...ends);
  }
  return segments;
}
