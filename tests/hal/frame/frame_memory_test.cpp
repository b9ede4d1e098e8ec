// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/frame_memory.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

DmaBufferSource source(std::string name) { return {std::move(name), nullptr}; }

TEST(FrameMemory, IsTheFirstThatWorks) {
  std::string tried;
  const FrameMemory memory =
      choose_memory({source("a"), source("b"), source("c")}, [&](const DmaBufferSource& from) {
        tried += from.name;
        return from.name == "b" ? Result<>() : fail("is full");
      });
  EXPECT_EQ(tried, "ab");
  EXPECT_EQ(memory.source, "b");
  EXPECT_EQ(to_text(memory, 10, 10), "10 buffers from b (a: is full)");
}

TEST(FrameMemory, IsTheDriversWithTheReasonWhereNoneWorks) {
  const auto refuse = [](const DmaBufferSource&) -> Result<> { return fail("is full"); };
  EXPECT_EQ(to_text(choose_memory({source("a"), source("b")}, refuse), 4, 10),
            "4 buffers instead of 10 in memory of the driver, which the CPU may not cache "
            "(a: is full; b: is full)");
  EXPECT_EQ(to_text(choose_memory({}, refuse), 10, 10),
            "10 buffers in memory of the driver, which the CPU may not cache (there is no "
            "dma-heap for it)");
}

}  // namespace
}  // namespace orbwatch::hal
