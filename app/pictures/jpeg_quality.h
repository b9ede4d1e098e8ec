#pragma once

#include <cstddef>

namespace orbwatch::app {

/// How JPEG pictures are made.
struct JpegSettings {
  int quality = 85;              ///< 1 to 100, the best that is used
  std::size_t target_bytes = 0;  ///< of a picture; 0: no limit
  double rate = 0;               ///< pictures per second at most; 0: all
};

/// Finds the quality that keeps pictures below a size: down at once, by how much they are too
/// large, and up again in small steps while there is room. Thread-bound.
class JpegQuality {
 public:
  static constexpr int kLeast = 10;

  explicit JpegQuality(const JpegSettings& settings)
      : best_(settings.quality), target_(settings.target_bytes), quality_(settings.quality) {}

  int now() const { return quality_; }

  /// Tells how large a picture of this quality became. True: too large and the quality is lower
  /// now, so it should be made again. Each picture is made again kMaxRepeats times at most.
  bool note(std::size_t bytes);

 private:
  static constexpr int kMaxRepeats = 4;
  /// A picture this much below the target leaves room for a better one.
  static constexpr double kRoom = 0.9;

  int best_;
  std::size_t target_;
  int quality_;
  int repeats_ = 0;
};

}  // namespace orbwatch::app
