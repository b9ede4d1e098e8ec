// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/mbap_framer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::modbus {
namespace {

using tests::Bytes;
using tests::frame;

/// Writes as many of the bytes as fit, then reads the complete frames.
std::size_t feed(MbapFramer& framer, std::span<const std::uint8_t> bytes,
                 std::vector<Bytes>& frames) {
  const auto room = framer.room();
  const std::size_t count = std::min(room.size(), bytes.size());
  std::ranges::copy(bytes.first(count), room.begin());
  framer.commit(count);
  while (const auto next = framer.next()) frames.emplace_back(next->begin(), next->end());
  return count;
}

TEST(MbapFramer, CutsTheSameFramesWhateverThePieces) {
  std::mt19937 random(20240601);
  std::vector<Bytes> sent;
  Bytes stream;
  for (std::size_t size = 1; size <= 253; ++size) {
    sent.push_back(frame(Bytes(size, static_cast<std::uint8_t>(size)), 1, 7));
    stream.insert(stream.end(), sent.back().begin(), sent.back().end());
  }
  for (const std::size_t largest : {1, 7, 100, 260, 5000}) {
    MbapFramer framer;
    std::vector<Bytes> received;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t piece = 1 + random() % largest;
      const auto rest = std::span(stream).subspan(at);
      const std::size_t taken = feed(framer, rest.first(std::min(piece, rest.size())), received);
      ASSERT_GT(taken, 0U) << "there must always be room";
      at += taken;
    }
    EXPECT_EQ(received, sent) << largest;
    EXPECT_TRUE(framer.is_empty());
    EXPECT_FALSE(framer.is_broken());
  }
}

TEST(MbapFramer, IsStrictAboutTheHeader) {
  const Bytes wrong[] = {{0, 1, 0, 1, 0, 6},
                         {0, 1, 1, 0, 0, 6},
                         {0, 1, 0, 0, 0, 0},
                         {0, 1, 0, 0, 0, 1},
                         {0, 1, 0, 0, 0, 255},
                         {0, 1, 0, 0, 1, 6},
                         {'G', 'E', 'T', ' ', '/', ' '}};
  for (const Bytes& header : wrong) {
    MbapFramer framer;
    std::vector<Bytes> frames;
    feed(framer, frame({4, 0, 0, 0, 1}), frames);
    feed(framer, header, frames);
    EXPECT_TRUE(framer.is_broken());
    feed(framer, frame({4, 0, 0, 0, 1}), frames);
    EXPECT_EQ(frames.size(), 1U) << "nothing after it is a frame";
  }
}

TEST(MbapFramer, WaitsForTheRest) {
  const Bytes whole = frame({4, 0, 0, 0, 1});
  for (std::size_t cut = 1; cut < whole.size(); ++cut) {
    MbapFramer framer;
    std::vector<Bytes> frames;
    feed(framer, std::span(whole).first(cut), frames);
    EXPECT_TRUE(frames.empty());
    EXPECT_FALSE(framer.is_empty());
    feed(framer, std::span(whole).subspan(cut), frames);
    EXPECT_EQ(frames, std::vector<Bytes>{whole});
    EXPECT_TRUE(framer.is_empty());
  }
}

}  // namespace
}  // namespace orbwatch::app::modbus
