// SPDX-License-Identifier: GPL-2.0-or-later
// A pane: a canvas that shows a painter's picture through the camera. The picture is kept somewhat larger than the pane,
// so that panning copies pixels; what is slow to paint is painted when the hand rests.

const kMargin = 0.2;         // of the pane, on each side of it
const kSettleMs = 140;       // the hand rests
const kFastMs = 12;          // paints that may happen at every frame of a movement
const kDraftMs = 45;         // the same for drafts, which leave out lines
// While the mesh is turned: drafts of so many pixels to one, coarser or finer by the time that they take.
const kCoarse = [1, 1.5, 2, 3, 4], kSlowMs = 14, kQuickMs = 5;
const kLargestRatio = 2;     // device pixels to one of CSS

export class CanvasView {
  // painter.paint(ctx, image, view): see report_painter.js. view: {k, ox, oy, width, height, ratio, draft}
  constructor(canvas, camera, painter) {
    this.canvas = canvas;
    this.camera = camera;
    this.painter = painter;
    this.cache = document.createElement("canvas");
    this.cacheView = null;
    this.paintMs = 0;
    this.draftMs = 0;
    this.coarse = 2;
    this.stale = false;
    this.lastMove = -Infinity;
    this.paints = 0;
    this.frames = 0;
    camera.onChange(() => this.moved());
    new ResizeObserver(() => this.invalidate()).observe(canvas);
    window.addEventListener("beforeprint", () => {  // paper does not wait for the next frame
      this.cacheView = null;
      this.frame();
    });
  }
  get width() { return this.canvas.clientWidth; }
  get height() { return this.canvas.clientHeight; }
  // Is what is seen the picture in full, and nothing on its way?
  get settled() {
    if (this.width < 1) return true;
    const cached = this.cacheView;
    return !this.requested && Boolean(cached) && !this.stale && !cached.draft && covers(cached, this.viewNow(0)) && performance.now() - this.lastMove > kSettleMs;
  }

  moved() {
    this.lastMove = performance.now();
    this.request();
  }
  // It is seen from another side now.
  turned() {
    this.stale = true;
    this.moved();
  }
  // The picture has changed, not only where it is seen from.
  invalidate() {
    this.cacheView = null;
    this.request();
  }
  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.frame();
    });
  }

  // The view that the pane has now, in device pixels, with a margin around it.
  viewNow(margin, coarse = 1) {
    const ratio = Math.min(window.devicePixelRatio || 1, kLargestRatio) / coarse;
    const width = Math.round(this.width * ratio), height = Math.round(this.height * ratio);
    const mx = Math.round(margin * width), my = Math.round(margin * height);
    const k = this.camera.scale * ratio;
    return {k, ratio, mx, my, width: width + 2 * mx, height: height + 2 * my,
            ox: width / 2 + mx - k * this.camera.x, oy: height / 2 + my + k * this.camera.y};
  }

  frame() {
    const now = this.viewNow(0);
    if (now.width < 1 || now.height < 1) return;
    ++this.frames;
    const resting = performance.now() - this.lastMove > kSettleMs;
    const cached = this.cacheView;
    const covered = cached && !this.stale && covers(cached, now);
    if (!covered || (cached.draft && resting)) {
      if (resting || !cached || this.paintMs < kFastMs) this.paint(false);
      else if (this.stale) this.paintCoarse();
      else if (this.draftMs < kDraftMs) this.paint(true);
    }
    this.copy(now);
    clearTimeout(this.timer);
    if (!resting) this.timer = setTimeout(() => this.request(), kSettleMs + 20);
  }

  paintCoarse() {
    const start = performance.now();
    this.paintView({...this.viewNow(0, kCoarse[this.coarse]), draft: true});
    const ms = performance.now() - start;
    if (ms > kSlowMs) this.coarse = Math.min(this.coarse + 1, kCoarse.length - 1);
    if (ms < kQuickMs) this.coarse = Math.max(this.coarse - 1, 0);
  }

  paint(draft) {
    const start = performance.now();
    this.paintView({...this.viewNow(kMargin), draft});
    if (draft) this.draftMs = performance.now() - start;
    else this.paintMs = performance.now() - start;
  }

  paintView(view) {
    if (this.cache.width !== view.width || this.cache.height !== view.height) {
      this.cache.width = view.width;
      this.cache.height = view.height;
      this.image = null;
    }
    const ctx = this.cache.getContext("2d", {willReadFrequently: true});
    this.image ??= ctx.createImageData(view.width, view.height);
    this.painter.paint(ctx, this.image, view);
    this.cacheView = view;
    this.stale = false;
    ++this.paints;
  }

  copy(now) {
    const {canvas} = this, cached = this.cacheView;
    if (canvas.width !== now.width || canvas.height !== now.height) {
      canvas.width = now.width;
      canvas.height = now.height;
    }
    const ctx = canvas.getContext("2d");
    const zoom = now.k / cached.k;
    if (zoom !== 1 || !covers(cached, now)) {
      ctx.fillStyle = this.painter.background();
      ctx.fillRect(0, 0, now.width, now.height);
    }
    ctx.imageSmoothingEnabled = zoom !== 1;
    const x = now.ox - zoom * cached.ox, y = now.oy - zoom * cached.oy;
    if (zoom === 1) ctx.drawImage(this.cache, Math.round(x), Math.round(y));
    else ctx.drawImage(this.cache, x, y, zoom * cached.width, zoom * cached.height);
    this.painter.overlay?.(ctx, now);
  }

  // From a place in the pane (CSS pixels) to the plane.
  toPlane(px, py) {
    return [this.camera.x + (px - this.width / 2) / this.camera.scale,
            this.camera.y - (py - this.height / 2) / this.camera.scale];
  }
}

function covers(cached, now) {
  if (cached.k !== now.k || cached.ratio !== now.ratio) return false;
  const x = now.ox - cached.ox, y = now.oy - cached.oy;
  return x <= 0 && y <= 0 && x + cached.width >= now.width && y + cached.height >= now.height;
}
