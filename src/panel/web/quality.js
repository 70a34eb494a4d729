// Trades looks for speed where there is no graphics card to speak of.
const SLOW = 30; // ms from picture to picture; *assumed*, half the rate that is wanted
const PICTURES = 12; // of which more than half have to be slow; *assumed*

const LEVELS = [
  { ratio: 2, shadows: true },
  { ratio: 1, shadows: true },
  { ratio: 1, shadows: false },
  { ratio: 0.6, shadows: false },
];
export const WITHOUT_SHADOWS = 2;

// Whether pictures are drawn by the processor.
export function drawnInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software/i.test(name);
}

export class Quality {
  // `light`: the one that casts shadows. `level`: what to begin with, 0 for the best.
  constructor(renderer, light, level) {
    this.renderer = renderer;
    this.light = light;
    this.level = level;
    this.last = 0;
    this.begin();
    this.apply();
  }

  begin() {
    this.count = 0;
    this.slow = 0;
  }

  apply() {
    const { ratio, shadows } = LEVELS[this.level];
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, ratio));
    this.light.castShadow = shadows;
  }

  // No picture was wanted just now, so the time to the next says nothing.
  rest() {
    this.last = 0;
  }

  // A picture was drawn at `now` [ms]. True when it has to be drawn anew, in another quality. Single
  // ones may be late: the first of a new robot, or of a page that was out of sight.
  drew(now) {
    if (this.last) {
      ++this.count;
      if (now - this.last > SLOW) ++this.slow;
    }
    this.last = now;
    if (this.count < PICTURES) return false;
    const slow = this.slow > PICTURES / 2;
    this.begin();
    if (!slow || this.level + 1 === LEVELS.length) return false;
    ++this.level;
    this.apply();
    return true;
  }
}
