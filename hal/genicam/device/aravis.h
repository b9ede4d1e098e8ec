// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <memory>
#include <string>

namespace orbwatch::hal {

/// Owns a reference to an object of Aravis, released at its end.
struct ReleaseObject {
  void operator()(void* object) const { g_object_unref(object); }
};
template <class T>
using OwnedObject = std::unique_ptr<T, ReleaseObject>;

/// Frees memory of GLib.
struct FreeMemory {
  void operator()(const void* memory) const { g_free(const_cast<void*>(memory)); }
};
template <class T>
using OwnedMemory = std::unique_ptr<T, FreeMemory>;

/// Error of a call of Aravis: pass out() to the call, then query.
class AravisError {
 public:
  AravisError() = default;
  AravisError(const AravisError&) = delete;
  AravisError& operator=(const AravisError&) = delete;
  ~AravisError() { g_clear_error(&error_); }

  /// Clears the error of an earlier call.
  GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string message() const { return error_ != nullptr ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

/// Converts a text of Aravis, which may be null.
inline std::string text_of(const char* text) { return text != nullptr ? text : ""; }

}  // namespace orbwatch::hal
