// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <png.h>

#include <csetjmp>
#include <cstdio>

namespace orbwatch::hal {

/// Base of a reader or a writer of libpng: its failed calls as values.
class PngCalls {
 public:
  /// Runs a call of libpng; false when it failed. libpng's only way out of a failed call is
  /// longjmp, which skips destructors: `call`, and all that it calls, must have none to run.
  template <class Call>
  bool completes(Call call) {
    if (setjmp(way_out_) != 0) return false;
    call();
    return true;
  }

  /// Reason of the failed call.
  const char* message() const { return message_; }

 protected:
  /// Error handlers of a structure of libpng whose error pointer is calls().
  [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
    static_cast<PngCalls*>(png_get_error_ptr(png))->leave(text);
  }
  static void on_warning(png_structp, png_const_charp) {}
  PngCalls* calls() { return this; }

  /// Ends the running call as failed.
  [[noreturn]] void leave(const char* reason) {
    std::snprintf(message_, sizeof(message_), "%s", reason);
    std::longjmp(way_out_, 1);
  }

 private:
  std::jmp_buf way_out_{};  ///< return point of the running call of libpng
  char message_[256]{};
};

}  // namespace orbwatch::hal
