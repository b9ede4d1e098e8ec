// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace orbwatch {

/// A non-owning picture: `height` rows of `width` pixels, each of `channels` samples
/// of type T, interleaved. `stride` is the distance between rows in samples (not bytes) and may
/// exceed width * channels. Copying copies the reference, never the samples. Reentrant.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  int channels = 1;
  std::ptrdiff_t stride = 0;

  T* row(int y) const { return data + y * stride; }
  T* at(int x, int y) const { return row(y) + static_cast<std::ptrdiff_t>(x) * channels; }
  bool empty() const { return data == nullptr; }

  operator ImageView<const T>() const  // NOLINT(google-explicit-constructor): as T* to const T*
      requires(!std::is_const_v<T>) {
    return {data, width, height, channels, stride};
  }
};

/// Validity of a view's pixel, and the reason for an unknown one.
enum class Validity : std::uint8_t {
  Outside = 0,  ///< the direction's place on the ball lies outside every camera's picture
  Blind = 1,    ///< no camera sees the direction on the ball, or the camera that does has a fault
  Seen = 255,
};

}  // namespace orbwatch
