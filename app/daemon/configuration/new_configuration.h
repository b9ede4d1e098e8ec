// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/files/runtime/trial.h"

namespace orbwatch::app::daemon {

/// What a file is called beside the configuration file `site`: its path from there. Nullopt: it is
/// outside of that folder.
std::optional<std::string> name_beside(const std::filesystem::path& site,
                                       const std::filesystem::path& file);

/// A trial of the configuration file `site` with `texts` in place of it and of files beside it,
/// checked as it will stand there, as by `orbwatchd --check`. Of the files that stay it has those
/// that are not private. The texts are based on the files of now, except for those in `based_on`.
/// Errors: also a text that no file names.
Result<files::Trial> checked_trial(const std::filesystem::path& site, const files::FileTexts& texts,
                                   int seconds, files::FileChecksums based_on = {});

/// By their file, the lines by which texts differ from the files, see text_difference().
std::map<std::filesystem::path, std::string> differences_from_files(const files::FileTexts& texts);

}  // namespace orbwatch::app::daemon
