#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/doctor/board.h"
#include "app/files/configuration.h"
#include "app/model/health.h"
#include "hal/lines/line.h"

/// What the checks judge: no access to the computer is left in them. Texts come from devices and
/// files and may contain anything; nullopt is what cannot be known here.
namespace orbwatch::app::doctor {

struct ConfigurationFacts {
  std::filesystem::path file;
  bool exists = false;
  std::string error;  ///< why orbwatchd would refuse it; empty: it would not
};

struct BoardFacts {
  std::string model;  ///< what the board calls itself; empty: nothing
  std::optional<Board> known;
  std::filesystem::path folder;  ///< of the boards' files
  bool has_folder = false;
  std::vector<std::string> problems;  ///< files of it that cannot be read
};

struct Driver {
  std::string name;   ///< of the kernel's module
  std::string needs;  ///< who needs it, for people
  bool is_there = false;
};

struct KernelFacts {
  std::string release;          ///< as uname -r
  bool lists_drivers = false;   ///< whether the kernel's list of modules can be read
  std::vector<Driver> drivers;  ///< those that the configuration needs
};

struct Heap {
  std::string path;
  std::string error;  ///< why it cannot be opened; empty: it can
};

enum class Presence : std::uint8_t { There, Simulated, Missing, Closed, NoModule };

struct CameraFacts {
  std::string name;     ///< in the configuration
  std::string address;  ///< device, id or file
  Presence presence = Presence::There;
  std::string error{};                ///< why it is not There
  std::vector<std::string> others{};  ///< ids of the cameras that are
  std::string module{};               ///< that is not installed: a back-end's word
};

/// Of the service if it runs, else of this program.
struct LimitFacts {
  bool of_service = false;
  std::optional<std::uint64_t> realtime_priority;
  std::optional<std::uint64_t> locked_memory;    ///< bytes; the largest number: no limit
  bool may_set_priority = false;                 ///< CAP_SYS_NICE
  bool may_lock_memory = false;                  ///< CAP_IPC_LOCK
  std::optional<std::int64_t> realtime_runtime;  ///< us of realtime_period; -1: no limit
  std::optional<std::int64_t> realtime_period;   ///< us
  std::string cores_error;                       ///< why [threads] cores cannot be; empty: it can
};

struct NetworkFacts {
  std::optional<std::int64_t> largest_receive_buffer;  ///< net.core.rmem_max, bytes
  bool has_sysctl_file = false;                        ///< the package's
  std::optional<std::int64_t> first_free_port;         ///< below it a capability is needed
  bool has_unit = false;                               ///< orbwatch.service, which has it
};

struct PortFacts {
  std::string key;  ///< table of the configuration
  std::string address;
  int port = 0;
  int error = 0;              ///< errno of bind(); 0: it is free
  std::string holder{};       ///< name of the program that listens; empty: unknown
  bool service_runs = false;  ///< orbwatchd, whoever holds the port
};

struct FolderFacts {
  std::string use;
  std::filesystem::path path;
  std::optional<double> free{};        ///< MiB
  std::optional<double> free_share{};  ///< percent
  bool read_only = false;
  std::string error{};  ///< why it is not known; empty: it is
};

struct WatchdogFacts {
  bool is_there = false;
  std::optional<std::string> state;       ///< of the kernel: active, inactive
  std::optional<double> systemd_timeout;  ///< RuntimeWatchdogUSec, s; infinite: none
};

struct FirewallFacts {
  bool has_nft = false;
  std::optional<std::string> ruleset;  ///< of `nft -j list ruleset`; nullopt: it said nothing
  bool has_iptables = false;           ///< tables of the old kind
};

struct Facts {
  ConfigurationFacts configuration;
  std::optional<Configuration> site;  ///< what could be read of it
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

}  // namespace orbwatch::app::doctor
