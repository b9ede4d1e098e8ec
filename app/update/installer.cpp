// SPDX-License-Identifier: Apache-2.0
#include "app/update/installer.h"

#include <sys/socket.h>
#include <systemd/sd-bus.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

namespace orbwatch::app::update {
namespace {

constexpr const char* kService = "de.pengutronix.rauc";
constexpr const char* kObject = "/";
constexpr const char* kInterface = "de.pengutronix.rauc.Installer";
/// A slow board checks the signature of a large bundle.
constexpr std::chrono::microseconds kCallTime = std::chrono::minutes(3);

struct Unref {
  void operator()(sd_bus_message* message) const { sd_bus_message_unref(message); }
  void operator()(sd_bus_slot* slot) const { sd_bus_slot_unref(slot); }
};
using Message = std::unique_ptr<sd_bus_message, Unref>;
using Match = std::unique_ptr<sd_bus_slot, Unref>;

/// Error of a call, freed at its end.
class CallError {
 public:
  CallError() = default;
  CallError(const CallError&) = delete;
  CallError& operator=(const CallError&) = delete;
  ~CallError() { sd_bus_error_free(&error_); }
  sd_bus_error* get() { return &error_; }
  tl::unexpected<Error> as_result(int code) const {
    return fail(error_.message != nullptr ? error_.message : std::strerror(-code));
  }

 private:
  sd_bus_error error_{};
};

/// Signals about an installation that have arrived.
struct Events {
  std::optional<std::int32_t> completed;  ///< RAUC's result: 0 is success
  bool has_progress = false;
  bool is_gone = false;  ///< the service has ended
};

int on_completed(sd_bus_message* message, void* events, sd_bus_error*) {
  std::int32_t result = 0;
  if (const int code = sd_bus_message_read(message, "i", &result); code < 0) return code;
  static_cast<Events*>(events)->completed = result;
  return 0;
}

int on_properties(sd_bus_message*, void* events, sd_bus_error*) {
  static_cast<Events*>(events)->has_progress = true;
  return 0;
}

int on_owner(sd_bus_message* message, void* events, sd_bus_error*) {
  const char *name = nullptr, *before = nullptr, *after = nullptr;
  const int code = sd_bus_message_read(message, "sss", &name, &before, &after);
  if (code < 0) return code;
  static_cast<Events*>(events)->is_gone = *after == '\0';
  return 0;
}

Match match(sd_bus* bus, const std::string& rule, sd_bus_message_handler_t handler,
            Events& events) {
  sd_bus_slot* slot = nullptr;
  if (sd_bus_add_match(bus, &slot, rule.c_str(), handler, &events) < 0) slot = nullptr;
  return Match(slot);
}

/// Passes RAUC's progress on. A progress that cannot be read is left out: the end is what counts.
void report(sd_bus* bus, const std::function<void(int, const std::string&)>& on_progress) {
  CallError error;
  sd_bus_message* raw = nullptr;
  if (sd_bus_get_property(bus, kService, kObject, kInterface, "Progress", error.get(), &raw,
                          "(isi)") < 0) {
    return;
  }
  const Message answer(raw);
  std::int32_t percent = 0, depth = 0;
  const char* step = nullptr;
  if (sd_bus_message_read(raw, "(isi)", &percent, &step, &depth) > 0) on_progress(percent, step);
}

/// Handles messages until the installation has ended.
Result<> await_end(sd_bus* bus, Events& events,
                   const std::function<void(int, const std::string&)>& on_progress) {
  while (!events.completed) {
    if (events.is_gone) return fail("RAUC's service has ended during the installation");
    const int handled = sd_bus_process(bus, nullptr);
    if (handled < 0) return fail(std::string("D-Bus: ") + std::strerror(-handled));
    if (std::exchange(events.has_progress, false)) report(bus, on_progress);
    if (handled > 0) continue;
    if (const int code = sd_bus_wait(bus, UINT64_MAX); code < 0) {
      return fail(std::string("D-Bus: ") + std::strerror(-code));
    }
  }
  return {};
}

}  // namespace

void Installer::Close::operator()(sd_bus* bus) const { sd_bus_flush_close_unref(bus); }

Result<Installer> Installer::connect() {
  sd_bus* bus = nullptr;
  if (const int code = sd_bus_open_system(&bus); code < 0) {
    return fail(std::string("no system bus: ") + std::strerror(-code));
  }
  Installer installer{Bus(bus)};
  sd_bus_set_method_call_timeout(bus, static_cast<std::uint64_t>(kCallTime.count()));
  return installer;
}

void Installer::cancel() {
  // A call that waits receives the end of the connection.
  ::shutdown(sd_bus_get_fd(bus_.get()), SHUT_RDWR);
}

Result<std::string> Installer::text_property(const char* name) {
  CallError error;
  char* text = nullptr;
  const int code = sd_bus_get_property_string(bus_.get(), kService, kObject, kInterface, name,
                                              error.get(), &text);
  if (code < 0) return error.as_result(code);
  const std::unique_ptr<char, decltype(&std::free)> owned(text, &std::free);
  return std::string(text);
}

Result<std::string> Installer::compatible() { return text_property("Compatible"); }

Result<BundleLabel> Installer::inspect(const std::filesystem::path& bundle) {
  CallError error;
  sd_bus_message* raw = nullptr;
  const int code = sd_bus_call_method(bus_.get(), kService, kObject, kInterface, "Info",
                                      error.get(), &raw, "s", bundle.c_str());
  const Message answer(raw);
  if (code < 0) return error.as_result(code);
  const char *compatible = nullptr, *version = nullptr;
  if (const int read = sd_bus_message_read(raw, "ss", &compatible, &version); read < 0) {
    return fail(std::string("RAUC's answer cannot be read: ") + std::strerror(-read));
  }
  return BundleLabel{version, compatible};
}

Result<> Installer::install(
    const std::filesystem::path& bundle,
    const std::function<void(int percent, const std::string& step)>& on_progress) {
  Events events;
  const std::string signal = "type='signal',sender='" + std::string(kService) + "',";
  const Match completed = match(bus_.get(), signal + "member='Completed'", on_completed, events);
  const Match progress =
      match(bus_.get(), signal + "member='PropertiesChanged'", on_properties, events);
  const Match owner = match(bus_.get(),
                            "type='signal',sender='org.freedesktop.DBus',"
                            "member='NameOwnerChanged',arg0='" +
                                std::string(kService) + "'",
                            on_owner, events);
  if (!completed || !progress || !owner) return fail("D-Bus refuses to report the progress");
  CallError error;
  sd_bus_message* raw = nullptr;
  const int code = sd_bus_call_method(bus_.get(), kService, kObject, kInterface, "InstallBundle",
                                      error.get(), &raw, "sa{sv}", bundle.c_str(), 0);
  const Message answer(raw);
  if (code < 0) return error.as_result(code);
  if (auto ended = await_end(bus_.get(), events, on_progress); !ended) return ended;
  if (*events.completed == 0) return {};
  const auto reason = text_property("LastError");
  return fail(reason ? *reason : "RAUC's result is " + std::to_string(*events.completed));
}

}  // namespace orbwatch::app::update
