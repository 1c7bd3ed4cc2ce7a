#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace queries {

/// SHA-256, which servers of PostgreSQL compute too. Source: FIPS 180-4. Cost: linear.
using Sha256 = std::array<std::uint8_t, 32>;
Sha256 sha256(std::string_view bytes);

}  // namespace queries
