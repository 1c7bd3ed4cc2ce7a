/** The part of glTF's JSON that the server writes; see docs/http-api.md, section "Shapes". */

export interface GltfBufferView {
  readonly byteOffset?: number;
  readonly byteLength: number;
  readonly byteStride?: number;
}

export interface GltfAccessor {
  readonly bufferView?: number;
  readonly byteOffset?: number;
  readonly componentType: number;
  readonly count: number;
  readonly type: string;
  readonly normalized?: boolean;
}

export interface GltfPrimitive {
  readonly mode?: number;
  readonly attributes: Readonly<Record<string, number>>;
  readonly indices?: number;
  readonly extras?: {
    readonly role?: string;
    readonly tree?: number;
    readonly faceIds?: number;
    readonly vertexIds?: number;
    readonly deviation?: number;
  };
}

export interface GltfNode {
  readonly mesh?: number;
  readonly translation?: readonly number[];
  readonly extras?: {
    readonly row?: number;
    readonly box?: readonly number[];
    readonly triangles?: number;
    readonly shown?: number;
    readonly kind?: string;
  };
}

export interface Gltf {
  readonly nodes?: readonly GltfNode[];
  readonly meshes?: readonly { readonly primitives: readonly GltfPrimitive[] }[];
  readonly accessors?: readonly GltfAccessor[];
  readonly bufferViews?: readonly GltfBufferView[];
}

export const ComponentType = { i8: 5120, u8: 5121, i16: 5122, u16: 5123, u32: 5125, f32: 5126 } as const;
