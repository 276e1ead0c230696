// What the viewer's three pictures have in common.
import type { ModeNames, Picture, Rules, Theme } from "../data/answers";

export interface Settings {
  data: Picture & { rules: Rules };
  hidden: Set<string>;
  mode: ModeNames | undefined;
  dark: boolean;
}

export interface LociView {
  readonly element: HTMLElement;
  readonly hint: string;
  draw(): void;
}

export function themeOf(settings: Settings): Theme {
  return settings.dark ? settings.data.rules.themes.dark : settings.data.rules.themes.light;
}
