#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <mutex>
#include <optional>
#include <string_view>

#include "app/log.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Writes the log of the process while it lives: one at a time. A thread of its own writes what
/// comes from the frame path by log_soon(); log_line() writes on the caller's, after all that came
/// before. Made before the threads that log, and outlives them.
class LogWriter {
 public:
  /// May wait and allocate; never called twice at once.
  using Output = std::function<void(const LogRecord&)>;

  /// Lines of the frame path that may wait for the reader; more are dropped.
  static constexpr std::size_t kMaxWaiting = 64;
  /// Bytes of such a line; the rest is cut.
  static constexpr std::size_t kMaxText = 512;

  explicit LogWriter(Output output);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Writes what waits.
  ~LogWriter();

  /// The one that lives, or null.
  static LogWriter* current();

  void write(const LogRecord& record);
  void write_soon(LogLevel level, std::initializer_list<std::string_view> text,
                  const LogFields& fields);

  /// Returns when all that was logged before is written.
  void flush();

 private:
  template <std::size_t kMost>
  class Text {
   public:
    void append(std::string_view part);
    std::string_view view() const { return {bytes_.data(), size_}; }

   private:
    std::array<char, kMost> bytes_{};
    std::size_t size_ = 0;
  };

  struct Waiting {
    LogLevel level = LogLevel::Info;
    Text<kMaxText> text{};
    Text<64> camera{};
    Text<32> fault{};
    std::uint64_t trigger = 0;
  };

  std::optional<Waiting> next();
  void write_waiting();
  void write_dropped();

  const Output output_;
  std::mutex writing_;                        ///< held while output_ is called
  std::mutex queue_;                          ///< held for a copy, never while output_ is called
  std::array<Waiting, kMaxWaiting> waiting_;  ///< a ring; under queue_, as all below
  std::size_t oldest_ = 0;
  std::size_t count_ = 0;
  std::uint64_t dropped_ = 0;
  hal::Thread thread_;
};

}  // namespace orbwatch::app
