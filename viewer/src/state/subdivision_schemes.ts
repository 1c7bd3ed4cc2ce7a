/** The subdivision schemes, as the kernel describes them; tests/unit/subdivision/viewer_schemes_test.cpp writes this. */
export const subdivisionSchemes = [
  { name: "catmull-clark", takesTrianglesOnly: false, hasLimit: true, variants: [] },
  { name: "doo-sabin", takesTrianglesOnly: false, hasLimit: true, variants: ["mean", "doo", "open"] },
  { name: "loop", takesTrianglesOnly: true, hasLimit: true, variants: ["loop", "warren"] },
  { name: "butterfly", takesTrianglesOnly: true, hasLimit: false, variants: [] },
  { name: "modified-butterfly", takesTrianglesOnly: true, hasLimit: false, variants: [] },
  { name: "sqrt3", takesTrianglesOnly: true, hasLimit: false, variants: [] },
] as const;
