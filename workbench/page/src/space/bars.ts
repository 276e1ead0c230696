// Links as bars among surfaces over the place of the end effector.
import type { ModelFacts, Pose } from "../data/answers";

/** Ends of lines, m; none where the coordinates are not x, y and z of the end effector, whose axes the surfaces have. */
export function barsOf(facts: ModelFacts, pose: Pose): number[][][] {
  const place = (name: string): number[] => pose.posture[name] ?? [];
  const end = place(facts.end_effector.at);
  const rounding = 1e-9 * Math.max(...end.map(Math.abs));
  if (!facts.spatial || end.length !== 3 || !end.every((value, k) => Math.abs(value - (pose.at[k] ?? NaN)) <= rounding)) return [];
  const links = facts.links.map((link) => link.points.map(place)).map((points) => (points.length > 2 && points[0] ? [...points, points[0]] : points));
  // A telescopic leg reaches from its cylinder's point to its rod's.
  const first = (link: string): string | undefined => facts.links.find((one) => one.name === link)?.points[0];
  const legs = facts.joints.filter((joint) => joint.type === "prismatic").flatMap((joint) => {
    const [from, to] = [first(joint.from), first(joint.to)];
    return from && to ? [[place(from), place(to)]] : [];
  });
  return [...links, ...legs].filter((line) => line.length > 1 && line.every((point) => point.length === 3));
}
