// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "app/model/configuration_files.h"
#include "app/ports/web/routes.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// A new configuration as sent.
struct ConfigurationBody {
  ConfigurationFiles::Edit edit;
  int seconds = kUsualTrial;
};

inline constexpr BodyMember kFilesMember{"files", "New texts by file name, for the files to change",
                                         true, BodyType::Texts};
inline constexpr BodyMember kBasedOnMember{
    "based_on",
    "Checksums of files as GET /api/v1/configuration returned them: 409 if one was changed since "
    "then, with user and time",
    false, BodyType::Texts};
inline constexpr BodyMember kSecondsMember{
    "seconds", "Time until the trial is reverted unless it is confirmed, 10 to 3600; default: 60",
    false, BodyType::Whole};

/// {"files": {"rig.toml": "..."}, "based_on": {"rig.toml": "0a1b2c3d"}, "seconds": 60}. Errors: not
/// such an object; a member is missing, unknown or of another type; the seconds are out of range.
/// Reentrant.
Result<ConfigurationBody> parse_configuration(std::string_view body);

/// Value of kSecondsMember in a sent object. Errors: those of parse_configuration(). Reentrant.
Result<int> seconds_of(const nlohmann::json& sent);

}  // namespace orbwatch::app::web
