/** The loaded shapes of all columns, each with its levels of detail, and which of these are drawn. */

import { Box3, Object3D, Vector3 } from "three";

import type { CameraState, CellRef, ColumnRef, ShapeInfo, ShapeSource } from "./api";
import type { Shape } from "../glb/shapes";
import type { Body } from "./body";
import { kPlanesPerFrame } from "./front_faces";
import type { EyeFrom } from "./front_faces";
import { Chunk, kChunkVertices, kSmallVertices, vertexCount } from "./chunk";
import { primitiveOf } from "./geometry";
import { isSameLook } from "./look";
import type { Look, Style } from "./look";
import type { SharedMaterials } from "./materials";
import { SingleBody } from "./single_body";
import { toBox3, toVector3 } from "./vec";

/** So many small shapes of one answer are worth a chunk. */
const kMergeFrom = 24;

export interface Level {
  readonly shape: Shape;
  readonly body: Body;
}

/** One object: a cell with its levels, coarse ones first. */
export class ShapeRecord {
  readonly levels: Level[] = [];
  hidden = false;
  look: Look | null = null;

  constructor(
    readonly column: Column,
    readonly row: number,
    /** Tells what the value is like; the same for all levels. */
    public firstShape: Shape,
    /** That of the column when the levels were loaded. */
    public generation: number,
  ) {}

  get cell(): CellRef {
    return { result: this.column.source.result, row: this.row, column: this.column.source.column };
  }

  get finest(): Level | undefined {
    return this.levels.at(-1);
  }

  get visible(): boolean {
    return !this.hidden && this.column.visible;
  }

  /** Triangles of the value. */
  get triangles(): number {
    return this.firstShape.triangles;
  }

  get shown(): number {
    return this.finest?.shape.shown ?? 0;
  }

  get deviation(): number {
    const faces = this.finest && primitiveOf(this.finest.shape, "faces");
    return faces?.deviation ?? 0;
  }

  /** With the offset of an exploded picture. */
  box(target = new Box3()): Box3 {
    const { box } = this.firstShape;
    if (!box) return target.makeEmpty();
    target.copy(toBox3(box));
    const offset = this.look?.offset;
    return offset ? target.translate(new Vector3(...offset)) : target;
  }

  info(): ShapeInfo {
    return {
      cell: this.cell,
      kind: this.firstShape.kind,
      box: this.firstShape.box,
      triangles: this.triangles,
      shown: this.shown,
      deviation: this.deviation,
      visible: this.visible,
      offset: this.look?.offset ?? [0, 0, 0],
    };
  }
}

export class Column {
  readonly records = new Map<number, ShapeRecord>();
  visible = true;
  /** Shapes of former generations are out of date, and replaced as new ones come. */
  generation = 0;

  /** Tells it apart from the other visible columns by its colour; null while it is hidden. */
  colorSlot: number | null = null;

  constructor(readonly source: ShapeSource) {}
}

export function sameColumn(a: ColumnRef, b: ColumnRef): boolean {
  return a.result === b.result && a.column === b.column;
}

export function cellKey(cell: CellRef): string {
  return `${cell.result} ${cell.row} ${cell.column}`;
}

export class ShapeStore {
  readonly root = new Object3D();
  readonly columns: Column[] = [];
  private readonly chunks = new Set<Chunk>();
  private style: Style | null = null;
  private coarse = false;

  constructor(private readonly materials: SharedMaterials) {
    this.root.name = "shapes";
  }

  addColumn(source: ShapeSource): Column {
    const column = new Column(source);
    this.columns.push(column);
    return column;
  }

  /** Gives each visible column the lowest free slot, which it keeps as long as it is visible. */
  assignColorSlots(): void {
    for (const column of this.columns) if (!column.visible) column.colorSlot = null;
    const used = new Set(this.columns.map(({ colorSlot }) => colorSlot));
    for (const column of this.columns) {
      if (!column.visible || column.colorSlot !== null) continue;
      let slot = 0;
      while (used.has(slot)) slot++;
      used.add(slot);
      column.colorSlot = slot;
    }
  }

  column(ref: ColumnRef): Column | undefined {
    return this.columns.find((column) => sameColumn(column.source, ref));
  }

  record(cell: CellRef): ShapeRecord | undefined {
    return this.column(cell)?.records.get(cell.row);
  }

  *records(): Generator<ShapeRecord> {
    for (const column of this.columns) yield* column.records.values();
  }

  /** Those of which something is there. */
  visibleColumns(): readonly Column[] {
    return this.columns.filter(({ visible, records }) => visible && records.size > 0);
  }

  *visibleRecords(): Generator<ShapeRecord> {
    for (const record of this.records()) if (record.visible) yield record;
  }

  /** Adds shapes of one answer as the finest levels of their rows. The first level is kept for moving. */
  addShapes(column: Column, shapes: readonly Shape[]): ShapeRecord[] {
    return [...this.adding(column, shapes)].flat();
  }

  /** The same bit by bit: each step adds the shapes of one chunk, or one that is not merged with others. */
  *adding(column: Column, shapes: readonly Shape[]): Generator<ShapeRecord[]> {
    const small = shapes.filter((shape) => vertexCount(shape) <= kSmallVertices);
    const merged = new Set(small.length < kMergeFrom ? [] : small);
    for (const group of groupsOf([...merged])) {
      const chunk = new Chunk(group, this.root, this.materials);
      this.chunks.add(chunk);
      yield chunk.makeBodies().map((body) => this.addLevel(column, body));
    }
    for (const shape of shapes) if (!merged.has(shape)) yield [this.addLevel(column, this.single(shape))];
  }

  private addLevel(column: Column, body: Body): ShapeRecord {
    const { shape } = body;
    const record =
      column.records.get(shape.row) ?? new ShapeRecord(column, shape.row, shape, column.generation);
    column.records.set(shape.row, record);
    const kept = record.generation === column.generation ? 1 : 0;
    while (record.levels.length > kept) record.levels.pop()!.body.dispose();
    record.generation = column.generation;
    record.firstShape = record.levels[0]?.shape ?? shape;
    record.levels.push({ shape, body });
    if (this.style) body.setStyle(this.style);
    if (record.look) body.setLook(record.look);
    this.showLevel(record);
    return record;
  }

  private single(shape: Shape): Body {
    return new SingleBody(shape, this.root, this.materials);
  }

  /** Drops the finest level of an object if there is a coarser one. */
  dropFinest(record: ShapeRecord): void {
    if (record.levels.length < 2) return;
    record.levels.pop()!.body.dispose();
    this.showLevel(record);
  }

  removeColumn(column: Column): void {
    for (const record of column.records.values()) for (const level of record.levels) level.body.dispose();
    column.records.clear();
    this.columns.splice(this.columns.indexOf(column), 1);
  }

  setLook(record: ShapeRecord, look: Look): void {
    if (record.look && isSameLook(record.look, look)) return;
    record.look = look;
    for (const { body } of record.levels) body.setLook(look);
    this.showLevel(record);
  }

  setStyle(style: Style): void {
    this.style = style;
    for (const record of this.records()) for (const { body } of record.levels) body.setStyle(style);
  }

  /** Coarse levels are drawn instead of the finest, as while the camera moves on a slow machine. */
  setCoarse(coarse: boolean): void {
    if (this.coarse === coarse) return;
    this.coarse = coarse;
    this.refreshVisibility();
  }

  refreshVisibility(): void {
    for (const record of this.records()) this.showLevel(record);
  }

  private showLevel(record: ShapeRecord): void {
    const shown = this.coarse ? record.levels[0] : record.finest;
    // Without a look it has no colour and no place.
    const isSeen = record.visible && record.look !== null;
    for (const level of record.levels) level.body.setVisible(isSeen && level === shown);
  }

  /** To be called before drawing; `eyeFrom` if triangles that show their backs are to be left out here. */
  update({ target, height }: CameraState, eyeFrom: EyeFrom | null): void {
    const budget = { triangles: kPlanesPerFrame };
    for (const chunk of this.chunks) {
      if (chunk.isFree) this.chunks.delete(chunk);
      chunk.approach(toVector3(target), height);
      chunk.update();
      chunk.chooseFronts(eyeFrom, budget);
    }
    for (const record of this.visibleRecords()) {
      for (const { body } of record.levels) body.chooseFronts(eyeFrom, budget);
    }
  }

  /** Triangles that are drawn at rest, and while coarse. */
  triangleCounts(): { fine: number; coarse: number } {
    let [fine, coarse] = [0, 0];
    for (const record of this.visibleRecords()) {
      fine += record.shown;
      coarse += record.levels[0]?.shape.shown ?? 0;
    }
    return { fine, coarse };
  }

  box(records: Iterable<ShapeRecord> = this.visibleRecords()): Box3 {
    const box = new Box3();
    const part = new Box3();
    for (const record of records) box.union(record.box(part));
    return box;
  }

  /** Of the objects that are selected and seen. */
  selectedBox(): Box3 {
    return this.box([...this.visibleRecords()].filter(({ look }) => look?.selected));
  }

  /** The centre of all visible objects, not exploded. */
  centre(): Vector3 {
    const all = new Box3();
    for (const { firstShape } of this.visibleRecords()) if (firstShape.box) all.union(toBox3(firstShape.box));
    return all.isEmpty() ? new Vector3() : all.getCenter(new Vector3());
  }

  dispose(): void {
    for (const column of [...this.columns]) this.removeColumn(column);
  }
}

function groupsOf(shapes: readonly Shape[]): Shape[][] {
  const groups: Shape[][] = [];
  let vertices = Infinity;
  for (const shape of shapes) {
    const count = vertexCount(shape);
    if (vertices + count > kChunkVertices) {
      groups.push([]);
      vertices = 0;
    }
    groups.at(-1)!.push(shape);
    vertices += count;
  }
  return groups;
}
