// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <mutex>
#include <vector>

#include "tests/compliance/compliance.h"
#include "tests/compliance/kept_frame.h"

/// Held frames stay valid.
namespace orbwatch::tests {
namespace {

using namespace std::chrono_literals;

/// Consumer that keeps its frames.
class Hoard {
 public:
  void add(const hal::Frame& frame) {
    KeptFrame kept(frame);
    const std::lock_guard lock(mutex_);
    if (keeps_) frames_.push_back(std::move(kept));
  }
  void expect_unchanged() const {
    const std::lock_guard lock(mutex_);
    EXPECT_FALSE(frames_.empty());
    for (const KeptFrame& frame : frames_) {
      EXPECT_TRUE(frame.is_unchanged()) << "frame " << frame.metadata().sequence;
    }
  }
  /// Releases all frames and keeps no more.
  void release() {
    std::vector<KeptFrame> released;
    const std::lock_guard lock(mutex_);
    keeps_ = false;
    released.swap(frames_);
  }

 private:
  mutable std::mutex mutex_;
  bool keeps_ = true;
  std::vector<KeptFrame> frames_;
};

class HeldFrames : public Compliance {
 protected:
  /// Duration long enough for a camera that still has a buffer to deliver.
  hal::Clock::duration silence() const {
    const double periods = format.frame_rate > 0 ? 20 / format.frame_rate : 0;
    return std::max<hal::Clock::duration>(2s, std::chrono::duration_cast<hal::Clock::duration>(
                                                  std::chrono::duration<double>(periods)));
  }
  /// Keeps frames until no more arrive.
  void run_dry(Witness& witness) const {
    constexpr std::size_t kMostBuffers = 64;
    std::size_t seen = 0;
    witness.wait_for_frames(1);
    while (witness.wait_for_more(seen, silence())) {
      seen = witness.frames().size();
      ASSERT_LE(seen, kMostBuffers) << "a camera whose frames are kept takes ever more memory";
    }
  }
};

TEST_F(HeldFrames, ASlowConsumerCostsFramesAndNothingElse) {
  Hoard hoard;
  Witness witness(format, [&](const hal::Frame& frame) { hoard.add(frame); });
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  ASSERT_NO_FATAL_FAILURE(run_dry(witness));
  const auto held = witness.frames();
  hoard.expect_unchanged();
  hoard.release();
  witness.wait_for_frames(held.size() + subject.limited(5));
  witness.stop(*camera);
  std::uint64_t lost = 0;
  const auto frames = witness.frames();
  for (std::size_t i = 1; i < frames.size(); ++i) {
    lost += frames[i].sequence - frames[i - 1].sequence - 1;
  }
  EXPECT_EQ(lost > 0, subject.counts_all()) << "frames are lost, as the sequence tells";
  EXPECT_TRUE(witness.faults().empty()) << witness.faults().front().detail;
}

TEST_F(HeldFrames, StayUnchangedAfterStopAndNextStreamsAndTheCamera) {
  Hoard hoard;
  {
    Witness witness(format, [&](const hal::Frame& frame) { hoard.add(frame); });
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.wait_for_frames(3);
    witness.stop(*camera);
  }
  hoard.expect_unchanged();
  ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
  hoard.expect_unchanged();
  // Some buffers may still be lent: the camera uses the others, or new ones.
  Hoard few;
  {
    Witness witness(format, [&](const hal::Frame& frame) { few.add(frame); });
    ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
    witness.wait_for_frames(1);
    camera.reset();
    witness.close();
  }
  hoard.expect_unchanged();
  few.expect_unchanged();
}

TEST_F(HeldFrames, AreReleasedOnAnyThreadWhileItStreams) {
  Hoard hoard;
  Witness witness(format, [&](const hal::Frame& frame) { hoard.add(frame); });
  ASSERT_NO_FATAL_FAILURE(witness.start(*camera));
  witness.wait_for_frames(2);
  std::thread other([&] { hoard.release(); });
  witness.wait_for_frames(subject.limited(13));
  other.join();
  witness.stop(*camera);
}

}  // namespace
}  // namespace orbwatch::tests
