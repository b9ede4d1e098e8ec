// SPDX-License-Identifier: Apache-2.0
#include "tests/app/update/fake_rauc.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace orbwatch::app::update::tests {
namespace {

constexpr const char* kRauc = "de.pengutronix.rauc";
constexpr const char* kRaucInstaller = "de.pengutronix.rauc.Installer";

/// Sends a signal of the service, and frees it.
void send_as_rauc(sd_bus* bus, sd_bus_message* signal) {
  sd_bus_message_set_sender(signal, kRauc);
  sd_bus_send(bus, signal, nullptr);
  sd_bus_message_unref(signal);
}

int refuse_call(sd_bus_message* call, const char* reason) {
  return sd_bus_reply_method_errorf(call, "org.gtk.GDBus.UnmappedGError", "%s", reason);
}

}  // namespace

FakeRauc::FakeRauc(const std::filesystem::path& folder, std::string compatible)
    : socket_(folder / "bus"),
      compatible_(std::move(compatible)),
      listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_.string().size() >= sizeof address.sun_path) throw std::runtime_error("long path");
  std::strcpy(address.sun_path, socket_.c_str());
  if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener_.get(), 4) != 0) {
    throw std::runtime_error("no socket " + socket_.string());
  }
  thread_ = std::thread([this] { run(); });
}

FakeRauc::~FakeRauc() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  woken_.signal();
  thread_.join();
}

std::string FakeRauc::address() const { return "unix:path=" + socket_.string(); }

void FakeRauc::finish(const std::string& error) {
  {
    const std::lock_guard lock(mutex_);
    result_ = error;
  }
  woken_.signal();
}

std::vector<std::filesystem::path> FakeRauc::installed() const {
  const std::lock_guard lock(mutex_);
  return installed_;
}

/// Serves one client after the other.
void FakeRauc::run() {
  while (true) {
    std::array<pollfd, 2> polled{{{listener_.get(), POLLIN, 0}, {woken_.get(), POLLIN, 0}}};
    ::poll(polled.data(), polled.size(), -1);
    {
      const std::lock_guard lock(mutex_);
      if (is_ended_) return;
    }
    if (polled[1].revents != 0) woken_.clear();
    if (polled[0].revents == 0) continue;
    if (const Bus bus = accept()) serve(bus.get());
  }
}

FakeRauc::Bus FakeRauc::accept() const {
  const int client = ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  sd_bus* raw = nullptr;
  if (client < 0 || sd_bus_new(&raw) < 0) return nullptr;
  Bus bus(raw);
  sd_id128_t id{};
  sd_id128_randomize(&id);
  if (sd_bus_set_fd(raw, client, client) < 0 || sd_bus_set_server(raw, 1, id) < 0 ||
      sd_bus_start(raw) < 0 ||
      sd_bus_add_filter(raw, nullptr, on_message, const_cast<FakeRauc*>(this)) < 0) {
    return nullptr;
  }
  return bus;
}

/// Until the client has gone, or this object ends.
void FakeRauc::serve(sd_bus* bus) {
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      if (is_ended_) return;
    }
    end_installation(bus);
    const int handled = sd_bus_process(bus, nullptr);
    if (handled < 0) return;
    if (handled > 0) continue;
    sd_bus_flush(bus);
    std::array<pollfd, 2> polled{
        {{sd_bus_get_fd(bus), static_cast<short>(sd_bus_get_events(bus)), 0},
         {woken_.get(), POLLIN, 0}}};
    ::poll(polled.data(), polled.size(), -1);
    if (polled[1].revents != 0) woken_.clear();
  }
}

void FakeRauc::end_installation(sd_bus* bus) {
  std::int32_t code = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!is_installing_ || !result_) return;
    is_installing_ = false;
    last_error_ = *std::exchange(result_, std::nullopt);
    code = last_error_.empty() ? 0 : 1;
  }
  sd_bus_message* signal = nullptr;
  sd_bus_message_new_signal(bus, &signal, "/", kRaucInstaller, "Completed");
  sd_bus_message_append(signal, "i", code);
  send_as_rauc(bus, signal);
}

int FakeRauc::on_message(sd_bus_message* message, void* rauc, sd_bus_error* /*error*/) {
  if (sd_bus_message_is_method_call(message, nullptr, nullptr) <= 0) return 0;
  const int code = static_cast<FakeRauc*>(rauc)->answer(message);
  return code < 0 ? code : 1;
}

int FakeRauc::answer(sd_bus_message* call) {
  const std::string member = sd_bus_message_get_member(call);
  if (member == "Hello") return sd_bus_reply_method_return(call, "s", ":1.1");
  if (member == "AddMatch" || member == "RemoveMatch") return sd_bus_reply_method_return(call, "");
  if (member == "Info") return answer_info(call);
  if (member == "InstallBundle") return answer_install(call);
  if (member == "Get") return answer_property(call);
  return refuse_call(call, ("no method " + member).c_str());
}

int FakeRauc::answer_info(sd_bus_message* call) {
  const char* bundle = nullptr;
  if (const int code = sd_bus_message_read(call, "s", &bundle); code < 0) return code;
  std::ifstream in(bundle);
  std::string word, kind, version;
  in >> word >> kind >> version;
  if (word == "bundle") {
    return sd_bus_reply_method_return(call, "ss", kind.c_str(), version.c_str());
  }
  return refuse_call(call, word == "foreign"
                               ? "signature verification failed: Verify error: self-signed"
                               : "Signature size (0) exceeds bundle size");
}

int FakeRauc::answer_install(sd_bus_message* call) {
  const char* bundle = nullptr;
  if (const int code = sd_bus_message_read(call, "s", &bundle); code < 0) return code;
  {
    const std::lock_guard lock(mutex_);
    installed_.emplace_back(bundle);
    is_installing_ = true;
    percent_ = 40;
  }
  const int code = sd_bus_reply_method_return(call, "");
  signal_progress(sd_bus_message_get_bus(call));
  return code;
}

void FakeRauc::signal_progress(sd_bus* bus) {
  sd_bus_message* signal = nullptr;
  sd_bus_message_new_signal(bus, &signal, "/", "org.freedesktop.DBus.Properties",
                            "PropertiesChanged");
  sd_bus_message_append(signal, "sa{sv}as", kRaucInstaller, 0, 0);
  send_as_rauc(bus, signal);
}

int FakeRauc::answer_property(sd_bus_message* call) {
  const char *interface = nullptr, *name = nullptr;
  if (const int code = sd_bus_message_read(call, "ss", &interface, &name); code < 0) return code;
  const std::lock_guard lock(mutex_);
  if (std::strcmp(name, "Progress") == 0) {
    return sd_bus_reply_method_return(call, "v", "(isi)", percent_, "Copying image to rootfs.1", 1);
  }
  const std::string& text = std::strcmp(name, "LastError") == 0 ? last_error_ : compatible_;
  return sd_bus_reply_method_return(call, "v", "s", text.c_str());
}

}  // namespace orbwatch::app::update::tests
