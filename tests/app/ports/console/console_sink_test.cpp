// SPDX-License-Identifier: Apache-2.0
#include "app/ports/console/console_sink.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Both ends of a console's output; the reader's end is non-blocking.
struct Ends {
  hal::FileDescriptor reader, writer;

  static Ends of_pipe() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::pipe(ends.data()), 0);
    return from(ends);
  }
  static Ends of_socket() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    return from(ends);
  }

  std::string read() const {
    std::string all;
    std::array<char, 4096> part{};
    for (ssize_t size = 0; (size = ::read(reader.get(), part.data(), part.size())) > 0;) {
      all.append(part.data(), static_cast<std::size_t>(size));
    }
    return all;
  }
  /// Writes until the end is full, and restores its flags.
  void fill() const {
    const int flags = ::fcntl(writer.get(), F_GETFL);
    ::fcntl(writer.get(), F_SETFL, flags | O_NONBLOCK);
    const std::string many(4096, '.');
    while (::write(writer.get(), many.data(), many.size()) > 0) {
    }
    while (::write(writer.get(), ".", 1) > 0) {
    }
    ::fcntl(writer.get(), F_SETFL, flags);
  }

 private:
  static Ends from(const std::array<int, 2>& ends) {
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    return {hal::FileDescriptor(ends[0]), hal::FileDescriptor(ends[1])};
  }
};

TEST(WaitlessOutput, DropsWholeTextsWhileNobodyReadsAndGoesOnAfterwards) {
  for (const auto& make : {&Ends::of_pipe, &Ends::of_socket}) {
    const Ends ends = make();
    WaitlessOutput out(ends.writer.get());
    EXPECT_TRUE(out.write("first\n"));
    EXPECT_EQ(ends.read(), "first\n");
    ends.fill();
    EXPECT_TRUE(out.write("under way\n")) << "it is kept";
    EXPECT_FALSE(out.write("dropped\n"));
    ends.read();
    EXPECT_TRUE(out.write("later\n"));
    EXPECT_EQ(ends.read(), "under way\nlater\n");
    EXPECT_EQ(::fcntl(ends.writer.get(), F_GETFL) & O_NONBLOCK, 0) << "others share the file";
  }
}

TEST(ConsoleSink, EndsAlthoughNobodyReadsAndCountsWhatItDropped) {
  const Ends ends = Ends::of_pipe();
  ConsoleSettings settings;
  settings.period = 0.1;
  ConsoleSink console(settings, {}, ends.writer.get());
  ASSERT_TRUE(console.start());
  ends.fill();
  const auto dropped = [&] { return console.metrics().front().value; };
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (dropped() == 0 && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
  EXPECT_GT(dropped(), 0);
  EXPECT_EQ(console.metrics().front().component.kind, "console");
  console.stop();
}

TEST(ConsoleSink, PrintsOnceMoreWhenItStops) {
  const Ends ends = Ends::of_pipe();
  ConsoleSettings settings;
  settings.period = 3600;
  ConsoleSink console(settings, {}, ends.writer.get());
  ASSERT_TRUE(console.start());
  console.stop();
  const std::string said = ends.read();
  EXPECT_THAT(said, StartsWith("at the end, after 0 s\n"));
  EXPECT_THAT(said, HasSubstr("system:"));
}

}  // namespace
}  // namespace orbwatch::app
