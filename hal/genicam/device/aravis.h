#pragma once

#include <arv.h>

#include <memory>
#include <string>

namespace orbwatch::hal {

/// A share in an object of Aravis, released at its end.
struct ReleaseObject {
  void operator()(void* object) const { g_object_unref(object); }
};
template <class T>
using OwnedObject = std::unique_ptr<T, ReleaseObject>;

/// Memory of GLib.
struct FreeMemory {
  void operator()(const void* memory) const { g_free(const_cast<void*>(memory)); }
};
template <class T>
using OwnedMemory = std::unique_ptr<T, FreeMemory>;

/// The error of a call of Aravis: pass out(), then ask.
class AravisError {
 public:
  AravisError() = default;
  AravisError(const AravisError&) = delete;
  AravisError& operator=(const AravisError&) = delete;
  ~AravisError() { g_clear_error(&error_); }

  /// Forgets the error of a call before.
  GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string message() const { return error_ != nullptr ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

/// A text of Aravis, which may be none.
inline std::string text_of(const char* text) { return text != nullptr ? text : ""; }

}  // namespace orbwatch::hal
