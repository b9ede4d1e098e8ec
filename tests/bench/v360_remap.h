// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tests/bench/frame.h"
#include "tests/bench/rig.h"

struct AVBufferRef;
struct AVFilterContext;
struct AVFilterGraph;
struct AVFrame;

namespace orbwatch::bench {

/// FFmpeg's v360 filter in this process, bilinear, on one thread. Its ball fills the picture, ours
/// leaves a margin of 10 px: else the views are the same. Throws std::runtime_error with FFmpeg's
/// message when it refuses something.
class V360Remap {
 public:
  /// True if v360 supports that format, or the planar one with the same samples: yuv420p for NV12,
  /// gbrp for BGR.
  static bool takes(PixelFormat format);

  /// The source is white noise of its own.
  V360Remap(const Rig& rig, PixelFormat format);

  /// Sends the same frame by reference, and receives the view.
  void run();

 private:
  struct Free {
    void operator()(AVFilterGraph* graph) const;
    void operator()(AVFrame* frame) const;
  };

  void wrap_source(const Rig& rig, PixelFormat format);
  void connect(const Rig& rig);

  std::vector<Plane> source_;
  std::unique_ptr<AVFilterGraph, Free> graph_;
  std::unique_ptr<AVFrame, Free> input_;
  std::unique_ptr<AVFrame, Free> view_;
  AVFilterContext* in_ = nullptr;   ///< owned by the graph
  AVFilterContext* out_ = nullptr;  ///< owned by the graph
};

}  // namespace orbwatch::bench
