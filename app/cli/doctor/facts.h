// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/doctor/board.h"
#include "app/files/configuration.h"
#include "app/model/status/health.h"
#include "hal/lines/line.h"

/// Input of the checks, which do not access the computer themselves. Texts come from devices and
/// files and may contain anything; nullopt marks facts that cannot be determined here.
namespace orbwatch::app::cli::doctor {

struct ConfigurationFacts {
  std::filesystem::path file;
  bool exists = false;
  std::string error;  ///< reason why orbwatchd would refuse it; empty: it would not
};

struct BoardFacts {
  std::string model;  ///< name that the board reports; empty: none
  std::optional<Board> known;
  std::filesystem::path folder;  ///< folder of the boards' files
  bool has_folder = false;
  std::vector<std::string> problems;  ///< files in it that cannot be read
};

struct Driver {
  std::string name;   ///< name of the kernel's module
  std::string needs;  ///< part that needs it, for people
  bool is_there = false;
};

struct KernelFacts {
  std::string release;          ///< value of uname -r
  bool lists_drivers = false;   ///< the kernel's list of modules can be read
  std::vector<Driver> drivers;  ///< drivers that the configuration needs
};

struct Heap {
  std::string path;
  std::string error;  ///< reason why it cannot be opened; empty: it can
};

enum class Presence : std::uint8_t { There, Simulated, Missing, Closed, NoModule };

struct CameraFacts {
  std::string name;     ///< name in the configuration
  std::string address;  ///< device, id or file
  Presence presence = Presence::There;
  std::string error{};                ///< reason why it is not There
  std::vector<std::string> others{};  ///< ids of the other cameras that are connected
  std::string module{};               ///< module that is not installed: a back-end's word
};

/// Limits of the service if it runs, else of this program.
struct LimitFacts {
  bool of_service = false;
  std::optional<std::uint64_t> realtime_priority;
  std::optional<std::uint64_t> locked_memory;    ///< bytes; the largest number: no limit
  bool may_set_priority = false;                 ///< CAP_SYS_NICE
  bool may_lock_memory = false;                  ///< CAP_IPC_LOCK
  std::optional<std::int64_t> realtime_runtime;  ///< us of realtime_period; -1: no limit
  std::optional<std::int64_t> realtime_period;   ///< us
  std::string cores_error;  ///< reason why [threads] cores cannot be used; empty: they can
};

struct NetworkFacts {
  std::optional<std::int64_t> largest_receive_buffer;  ///< value of net.core.rmem_max, bytes
  bool has_sysctl_file = false;                        ///< the package's file exists
  std::optional<std::int64_t> first_free_port;         ///< ports below it need a capability
  bool has_unit = false;  ///< orbwatch.service exists; it grants the capability
};

struct PortFacts {
  std::string key;  ///< table in the configuration
  std::string address;
  int port = 0;
  int error = 0;              ///< errno of bind(); 0: the port is free
  std::string holder{};       ///< program that listens; empty: unknown
  bool service_runs = false;  ///< orbwatchd runs, regardless of the port's holder
  /// Configuration of the orbwatchd that listens, if it is not the examined one; empty: it is, or
  /// it is unknown.
  std::filesystem::path other_configuration{};
};

/// Right of the configuration's service to a folder.
enum class Access : std::uint8_t { Unknown, Write, ReadOnly, Denied };

struct FolderFacts {
  std::string use;
  std::filesystem::path path;
  std::optional<double> free{};        ///< MiB
  std::optional<double> free_share{};  ///< percent
  bool read_only = false;
  std::string error{};  ///< reason why it is unknown; empty: it is known
  Access access = Access::Unknown;
  std::string unit{};  ///< unit that runs the configuration; empty: unknown
};

struct WatchdogFacts {
  bool is_there = false;
  std::optional<std::string> state;       ///< state that the kernel reports: active, inactive
  std::optional<double> systemd_timeout;  ///< RuntimeWatchdogUSec, s; infinite: none
};

struct FirewallFacts {
  bool has_nft = false;
  std::optional<std::string> ruleset;  ///< output of `nft -j list ruleset`; nullopt: it failed
  bool has_iptables = false;           ///< legacy tables exist
};

struct Facts {
  ConfigurationFacts configuration;
  std::optional<files::Configuration> site;  ///< readable part of the configuration
  BoardFacts board;
  KernelFacts kernel;
  std::vector<Heap> heaps;
  std::vector<CameraFacts> cameras;
  std::vector<hal::ChipInfo> chips;
  LimitFacts limits;
  Health health;
  bool has_battery_clock = false;
  NetworkFacts network;
  std::vector<PortFacts> ports;
  std::optional<std::string> missing_serial_line;  ///< device of [modbus.serial]
  std::vector<FolderFacts> folders;
  WatchdogFacts watchdog;
  FirewallFacts firewall;
};

}  // namespace orbwatch::app::cli::doctor
