/**
 * How finely frames are drawn. At rest: fully. While something moves, first the resolution is lowered as long as frames
 * take longer than they should, then edges are left out, then coarser levels of detail are taken.
 */

/** A frame should not take longer, in milliseconds. */
export const kFrameGoal = 33;
const kComfort = 20;

export interface QualityStep {
  /** Factor of the resolution. */
  readonly scale: number;
  readonly edges: boolean;
  /** Coarse levels of detail. */
  readonly coarse: boolean;
}

export const kFull: QualityStep = { scale: 1, edges: true, coarse: false };

const kSteps: readonly QualityStep[] = [
  kFull,
  { scale: 0.8, edges: true, coarse: false },
  { scale: 0.65, edges: true, coarse: false },
  { scale: 0.65, edges: false, coarse: false },
  { scale: 0.5, edges: false, coarse: false },
  { scale: 0.8, edges: true, coarse: true },
  { scale: 0.65, edges: false, coarse: true },
  { scale: 0.5, edges: false, coarse: true },
  { scale: 0.4, edges: false, coarse: true },
];
const kFirstCoarse = kSteps.findIndex(({ coarse }) => coarse);
/** The processor draws about so many triangles in a frame, measured with SwiftShader on two cores. */
const kSoftwareTriangles = 250_000;
/** Frames that are looked at before a step. */
const kWindow = 3;
/** The first frames of a movement, for which the renderer has to compile and to copy, show nothing. */
const kFirstFrames = 3;
/** After so many frames a step that was too slow is tried again. */
const kForgiven = 60;

export class Quality {
  private index: number;
  private times: number[] = [];
  private toSkip = 0;
  /** Steps that were too slow, and at which frame: not tried again for a while. */
  private readonly tooSlow = new Map<number, number>();
  private frame = 0;

  constructor(private readonly software: boolean) {
    this.index = software ? 2 : 0;
  }

  /** While moving. */
  get step(): QualityStep {
    return kSteps[this.index]!;
  }

  /** Takes note of how long a frame of a movement took, in milliseconds. */
  observe(milliseconds: number): void {
    this.frame++;
    if (this.toSkip > 0) {
      this.toSkip--;
      return;
    }
    this.times.push(milliseconds);
    if (this.times.length < kWindow) return;
    const median = [...this.times].sort((a, b) => a - b)[Math.floor(kWindow / 2)]!;
    this.times = [];
    if (median > kFrameGoal) this.faster(median);
    else if (median < kComfort && this.index > 0 && !this.isTooSlow(this.index - 1)) this.index--;
  }

  private isTooSlow(step: number): boolean {
    const since = this.tooSlow.get(step);
    return since !== undefined && this.frame - since < kForgiven;
  }

  private faster(median: number): void {
    this.tooSlow.set(this.index, this.frame);
    // Far too slow: triangles are the reason rather than pixels.
    const jump = median > 2.5 * kFrameGoal && this.index < kFirstCoarse;
    this.index = jump ? kFirstCoarse : Math.min(kSteps.length - 1, this.index + 1);
  }

  /** What is shown has changed: finer steps get another chance. */
  reset(): void {
    this.tooSlow.clear();
    this.times = [];
  }

  /**
   * A movement begins, and finer steps get another chance. Without hardware, coarse levels are drawn from the start where
   * the fine ones are too many.
   */
  begin(triangles: { readonly fine: number; readonly coarse: number }): void {
    this.reset();
    this.toSkip = kFirstFrames;
    const tooMany =
      this.software && triangles.fine > kSoftwareTriangles && triangles.coarse < triangles.fine / 2;
    if (!tooMany) return;
    this.index = Math.max(this.index, kFirstCoarse);
    for (let step = 0; step < kFirstCoarse; step++) this.tooSlow.set(step, Infinity);
  }
}
