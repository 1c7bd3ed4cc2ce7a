#pragma once

namespace algebra3d {

// 128-bit integers: an extension of all compilers for 64-bit machines.
__extension__ typedef __int128 Int128;            // NOLINT(modernize-use-using): `using` takes no __extension__
__extension__ typedef unsigned __int128 UInt128;  // NOLINT(modernize-use-using)

}  // namespace algebra3d
