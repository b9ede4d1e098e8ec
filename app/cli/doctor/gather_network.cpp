// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <sstream>

#include "app/cli/doctor/gather.h"
#include "app/cli/doctor/program_output.h"
#include "app/daemon/site/site_check.h"
#include "app/files/runtime/site_file.h"
#include "app/health/system_file.h"
#include "hal/socket_address.h"
#include "hal/thread/file_descriptor.h"

/// Facts about ports, limits of the network, packet filter.
namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestTable = std::size_t{1} << 20;  // bytes, 7000 sockets

/// errno of binding like orbwatchd; the port is free again at once, since nothing listened.
int bind_error(const std::string& address, int port) {
  const auto parsed = hal::parse_address(address, port);
  if (!parsed) return EINVAL;
  const hal::FileDescriptor socket(
      ::socket(parsed->family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) return errno;
  const int on = 1;
  if (::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0) return errno;
  return ::bind(socket.get(), parsed->get(), parsed->length) == 0 ? 0 : errno;
}

/// Adds the sockets that listen on `port`, by inode, from a table in the format of /proc/net/tcp.
void add_listeners(const fs::path& table, int port, std::set<std::string>& sockets) {
  std::istringstream lines(read_system_file(table, kLongestTable).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state, queues, timer, retries, user, timeout, inode;
    words >> number >> local >> remote >> state >> queues >> timer >> retries >> user >> timeout >>
        inode;
    constexpr const char* kListens = "0A";
    if (!words || state != kListens || local.find(':') == std::string::npos) continue;
    if (to_integer(local.substr(local.rfind(':') + 1), 16) == port) {
      sockets.insert("socket:[" + inode + "]");
    }
  }
}

bool has_one_of(const fs::path& process, const std::set<std::string>& sockets) {
  return std::ranges::any_of(entries(process / "fd"), [&](const fs::path& descriptor) {
    std::error_code error;
    return sockets.contains(fs::read_symlink(descriptor, error).string());
  });
}

/// Adds the program that listens.
void add_holder(const fs::path& proc, const fs::path& configuration, PortFacts& port) {
  const auto listener = listener_on(proc, port.port);
  if (!listener) return;
  port.holder = listener->name;
  if (port.holder != "orbwatchd") return;
  const auto other = configuration_of(listener->process);
  if (other && !is_same_file(*other, configuration)) port.other_configuration = *other;
}

/// Texts of a process's arguments or environment; nullopt: this user may not read them.
std::optional<std::vector<std::string>> texts_in(const fs::path& file) {
  constexpr std::size_t kLongest = std::size_t{2} << 20;  // the kernel's limit of both together
  const auto all = read_system_file(file, kLongest);
  if (!all) return std::nullopt;
  std::vector<std::string> texts;
  std::istringstream in(*all);
  for (std::string text; std::getline(in, text, '\0');) texts.push_back(text);
  return texts;
}

void gather_ports(const Sources& sources, Facts& facts) {
  for (const ListeningPort& port : daemon::listening_ports(facts.site->sinks)) {
    PortFacts found{.key = std::string(port.interface), .address = port.address, .port = port.port};
    found.error = bind_error(port.address, port.port);
    if (found.error == EADDRINUSE) {
      add_holder(sources.at("/proc"), facts.configuration.file, found);
    }
    found.service_runs = facts.limits.of_service;
    facts.ports.push_back(std::move(found));
  }
  const auto& modbus = std::get<ModbusSettings>(facts.site->sinks);
  if (modbus.enabled && modbus.serial && !sources.has(modbus.serial->device)) {
    facts.missing_serial_line = modbus.serial->device;
  }
}

}  // namespace

std::optional<Listener> listener_on(const fs::path& proc, int port) {
  std::set<std::string> sockets;
  for (const char* table : {"net/tcp", "net/tcp6"}) add_listeners(proc / table, port, sockets);
  if (sockets.empty()) return std::nullopt;
  for (const fs::path& process : entries(proc)) {
    if (!to_integer(process.filename().native()) || !has_one_of(process, sockets)) continue;
    const std::string name = read_system_file(process / "comm").value_or("");
    return Listener{name.substr(0, name.find('\n')), process};
  }
  return std::nullopt;
}

std::optional<fs::path> configuration_of(const fs::path& process) {
  const auto arguments = texts_in(process / "cmdline");
  if (!arguments) return std::nullopt;
  fs::path file;
  constexpr std::string_view kOption = "--config";
  for (std::size_t i = 0; i < arguments->size(); ++i) {
    const std::string& argument = (*arguments)[i];
    if (argument == kOption && i + 1 < arguments->size()) file = (*arguments)[i + 1];
    if (argument.starts_with("--config=")) file = argument.substr(kOption.size() + 1);
  }
  if (file.empty()) {
    const auto variables = texts_in(process / "environ");
    if (!variables) return std::nullopt;
    for (const std::string& variable : *variables) {
      if (variable.starts_with(kConfigVariable)) file = variable.substr(kConfigVariable.size());
    }
  }
  if (file.empty()) file = files::kDefaultSiteFile;
  if (file.is_absolute()) return file;
  std::error_code error;
  const fs::path folder = fs::read_symlink(process / "cwd", error);
  return error ? std::nullopt : std::optional(folder / file);
}

void gather_network(const Sources& sources, Facts& facts) {
  NetworkFacts& network = facts.network;
  const fs::path settings = sources.at("/proc/sys/net");
  network.largest_receive_buffer = read_integer(settings / "core/rmem_max");
  network.first_free_port = read_integer(settings / "ipv4/ip_unprivileged_port_start");
  network.has_sysctl_file = sources.has("/usr/lib/sysctl.d/60-orbwatch-dds.conf");
  network.has_unit = sources.has("/usr/lib/systemd/system/orbwatch.service") ||
                     sources.has("/lib/systemd/system/orbwatch.service");
  FirewallFacts& firewall = facts.firewall;
  const fs::path nft = sources.at("/usr/sbin/nft");
  firewall.has_nft = sources.has("/usr/sbin/nft");
  if (firewall.has_nft) firewall.ruleset = program_output(nft, {"-j", "list", "ruleset"});
  for (const char* tables : {"net/ip_tables_names", "net/ip6_tables_names"}) {
    const auto names = read_system_file(sources.at("/proc") / tables);
    firewall.has_iptables = firewall.has_iptables || (names && !names->empty());
  }
  if (facts.site) gather_ports(sources, facts);
}

}  // namespace orbwatch::app::cli::doctor
