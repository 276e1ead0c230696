import { describe, expect, it } from "vitest";
import { cut, trianglesOf } from "./meshes";

const base64 = (data: Float32Array | Uint32Array): string => Buffer.from(data.buffer).toString("base64");

describe("meshes", () => {
  const mesh = trianglesOf({ id: "s1", vertices: base64(new Float32Array([0, 0, 0, 1, 0, 0, 0, 0, 2])), triangles: base64(new Uint32Array([0, 1, 2])) });
  it("come out of base64 as they went in", () => {
    expect([...mesh.vertices]).toEqual([0, 0, 0, 1, 0, 0, 0, 0, 2]);
    expect([...mesh.triangles]).toEqual([0, 1, 2]);
  });
  it("are cut by a plane", () => {
    const places = cut(mesh, 2, 1);
    expect(places).toHaveLength(6);
    expect([places[0], places[3]].sort()).toEqual([0, 0.5]);
    expect([places[2], places[5]]).toEqual([1, 1]);
    expect(cut(mesh, 2, 3)).toEqual([]);
  });
});
