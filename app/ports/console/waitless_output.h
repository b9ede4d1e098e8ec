#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {

/// Writes texts to an open file without waiting for whoever reads it: a pipe, a terminal or a
/// socket that takes no more keeps the rest of the text under way, and while it does, further texts
/// are dropped whole. Thread-bound.
class WaitlessOutput {
 public:
  /// `file` stays the caller's, with its flags: others may share it.
  explicit WaitlessOutput(int file);

  /// False: the text was dropped.
  bool write(std::string_view text);

 private:
  void send();

  const int file_;
  hal::FileDescriptor own_;  ///< the same pipe or terminal, opened anew without waiting; or closed
  bool is_socket_ = false;
  std::string rest_;  ///< of the text under way
};

}  // namespace orbwatch::app
