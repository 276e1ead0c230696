import { defineConfig } from "vitest/config";

// Browser tests share one machine and one program each: one after another, with time for a busy machine.
export default defineConfig({
  test: {
    include: ["src/**/*.test.ts", "browser/**/*.test.ts"],
    fileParallelism: false,
    testTimeout: 180_000,
    hookTimeout: 120_000,
    reporters: ["default"],
    expect: { poll: { timeout: 60_000 } },
  },
});
