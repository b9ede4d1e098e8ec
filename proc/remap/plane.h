#pragma once

#include <cstddef>
#include <cstdint>

namespace orbwatch::remap {

/// A plane of a source, as a sampling reads it.
struct SourcePlane {
  const std::uint8_t* data = nullptr;  ///< with the sampling's offset
  std::ptrdiff_t stride = 0;           ///< bytes
  int width = 0;                       ///< in pixels of the plane
  int height = 0;
};

/// Part of a view's plane that is being filled.
struct TargetPlane {
  std::uint8_t* data = nullptr;
  std::ptrdiff_t stride = 0;  ///< bytes
  int columns = 0;            ///< in pixels of the plane, at most kTile
  int rows = 0;
};

}  // namespace orbwatch::remap
