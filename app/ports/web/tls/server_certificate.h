#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/certificates/certificate.h"
#include "app/certificates/dates.h"
#include "app/ports/web/http/pem_pair.h"
#include "app/ports/web/web_settings.h"
#include "proc/image/result.h"

/// What HTTPS is served with: an own certificate that the site's file names, or one that the
/// appliance makes itself and keeps in its state folder. All reentrant; they wait for the disk.
namespace orbwatch::app::web {

struct ServerCertificate {
  PemPair pem;
  ValidityPeriod validity;
  std::string fingerprint;  ///< SHA-256
  bool is_self_made = false;
};

/// Those that Apple's systems accept, with a day for clocks that differ.
inline constexpr std::chrono::days kSelfMadeDays{824};
/// A self-made one is replaced so long before its end.
inline constexpr std::chrono::days kRenewedBefore{60};

/// The certificate and the key that the settings name. Errors name the file: it cannot be read, is
/// none, may be read by everybody, is not the other's, or is not valid `now`.
Result<ServerCertificate> named_certificate(const WebSettings& settings, const Now& now);

/// The self-made one in the state folder. Nullopt: there is none. Errors: as read_private(); it is
/// damaged.
Result<std::optional<ServerCertificate>> kept_certificate(const std::filesystem::path& folder);

/// The system's clock: Unsure until it follows a time server.
enum class ClockState { Unsure, Synchronised };

/// The kept one as long as it is usable, not due and made for `hosts`; else a new one, kept with
/// mode 0600. Complains in the log about one that is not usable. Error: a new one cannot be
/// written.
Result<ServerCertificate> self_made_certificate(const std::filesystem::path& folder,
                                                const std::vector<std::string>& hosts,
                                                std::chrono::sys_seconds now,
                                                ClockState clock = ClockState::Unsure);

/// True: a self-made one is to be replaced: it ends soon, or `clock` is synchronised and it
/// begins later than now, made while the clock was ahead. With an unsure clock the latter stays,
/// because the clock is as likely to be behind.
bool is_due(const ServerCertificate& certificate, std::chrono::sys_seconds now,
            ClockState clock = ClockState::Unsure);

/// The names and addresses by which this computer is reached, as far as they are known beforehand.
std::vector<std::string> own_hosts(const WebSettings& settings);

/// "self-made certificate, valid until 2028-02-27, SHA-256 fingerprint 01:23:...".
std::string certificate_text(const ServerCertificate& certificate);

}  // namespace orbwatch::app::web
