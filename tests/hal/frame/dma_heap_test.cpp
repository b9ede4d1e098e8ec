// SPDX-License-Identifier: Apache-2.0
#include "hal/frame/dma_heap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>

#include "tests/hal/frame/udmabuf.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

using testing::ElementsAre;

/// Replaces /dev/dma_heap.
class DmaHeaps : public testing::Test {
 protected:
  void add(const char* heap) const { std::ofstream(folder_.path() / heap) << heap; }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const DmaBufferSource& heap : dma_heaps(folder_.path())) found.push_back(heap.name);
    return found;
  }

  tests::TemporaryFolder folder_;
};

TEST_F(DmaHeaps, AreListedTheBestFirst) {
  EXPECT_THAT(names(), ElementsAre());
  add("system");
  EXPECT_THAT(names(), ElementsAre("dma-heap system"));
  add("linux,cma");
  add("reserved");
  add("vidbuf_cached");
  EXPECT_THAT(names(),
              ElementsAre("dma-heap vidbuf_cached", "dma-heap linux,cma", "dma-heap system"));
}

TEST_F(DmaHeaps, ForAnyDeviceAreThoseThatNoneRefuses) {
  for (const char* heap : {"system", "vidbuf_cached", "linux,cma"}) add(heap);
  const auto heaps = dma_heaps_for_any_device(folder_.path());
  ASSERT_EQ(heaps.size(), 2U);
  EXPECT_EQ(heaps[0].name, "dma-heap vidbuf_cached");
  EXPECT_EQ(heaps[1].name, "dma-heap linux,cma");
}

TEST_F(DmaHeaps, AreNoneWithoutTheFolder) { EXPECT_TRUE(dma_heaps("/nowhere").empty()); }

TEST_F(DmaHeaps, AllocateFromTheHeapOfTheirName) {
  add("linux,cma");
  add("system");
  std::string allocated;
  const HeapAllocation allocate = [&](int heap, std::size_t bytes) -> Result<FileDescriptor> {
    std::array<char, 16> name{};
    EXPECT_GT(::read(heap, name.data(), name.size() - 1), 0);
    allocated += std::string(name.data()) + " " + std::to_string(bytes) + ", ";
    if (std::string_view(name.data()) == "linux,cma") return fail("has no memory");
    return allocate_shared_memory(bytes);
  };
  const FrameMemory memory = choose_memory(
      dma_heaps(folder_.path(), allocate), [](const DmaBufferSource& heap) -> Result<> {
        return heap.allocate(5000).and_then([](const DmaBuffer& buffer) -> Result<> {
          EXPECT_TRUE(buffer.map(5000));
          return {};
        });
      });
  EXPECT_EQ(allocated, "linux,cma 5000, system 5000, ");
  EXPECT_EQ(memory.source, "dma-heap system");
  EXPECT_EQ(memory.refusals, "dma-heap linux,cma: has no memory");
}

TEST_F(DmaHeaps, SayWhyTheyAllocateNothing) {
  add("system");
  const auto not_a_heap = dma_heaps(folder_.path())[0].allocate(4096);
  ASSERT_FALSE(not_a_heap);
  EXPECT_EQ(not_a_heap.error().message, "has no 4096 bytes: Inappropriate ioctl for device");
  const auto heaps = dma_heaps(folder_.path());
  std::filesystem::remove(folder_.path() / "system");
  const auto gone = heaps[0].allocate(4096);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().message, "cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace orbwatch::hal
