// All tools, in the order of the toolbar.
import { cylinderTool } from "./cylinder";
import { endEffectorTool } from "./end_effector";
import { forceTool } from "./force";
import { freeTool } from "./free";
import { groundPinTool } from "./ground_pin";
import { linkTool } from "./link";
import { massTool } from "./mass";
import { motorTool } from "./motor";
import { pinTool } from "./pin";
import { plateTool } from "./plate";
import { removeTool } from "./remove";
import { selectTool } from "./select";
import { sliderTool } from "./slider";
import { springTool } from "./spring";
import type { Tool } from "./tool";
import { workspaceTool } from "./workspace";

export const tools: readonly Tool[] = [
  selectTool,
  groundPinTool,
  linkTool,
  plateTool,
  pinTool,
  sliderTool,
  cylinderTool,
  motorTool,
  springTool,
  forceTool,
  massTool,
  endEffectorTool,
  freeTool,
  workspaceTool,
  removeTool,
];
