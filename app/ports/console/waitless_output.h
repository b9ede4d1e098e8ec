// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {

/// Writes texts to an open file without waiting for its reader: when a pipe, a terminal or a socket
/// is full, the rest of the present text is kept, and until it is written further texts are dropped
/// entirely. Thread-bound.
class WaitlessOutput {
 public:
  /// `file` remains owned by the caller, with its flags unchanged, because others may share it.
  explicit WaitlessOutput(int file);

  /// Writes or keeps a text. False: it was dropped.
  bool write(std::string_view text);

 private:
  void send();

  const int file_;
  hal::FileDescriptor own_;  ///< the same pipe or terminal, opened again as non-blocking; or closed
  bool is_socket_ = false;
  std::string rest_;  ///< unwritten rest of the present text
};

}  // namespace orbwatch::app
