// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/log_writer.h"

namespace orbwatch::app {

/// Fields of the journal beside those of systemd. They are documented in manuals and must not
/// change.
inline constexpr const char* kCameraField = "ORBWATCH_CAMERA";
inline constexpr const char* kFaultField = "ORBWATCH_FAULT";
inline constexpr const char* kTriggerField = "ORBWATCH_TRIGGER";

/// Output for the log of this process: with its fields to the journal if stderr is connected to it,
/// else as text to stderr, which also receives the lines that the journal refuses. Must not be
/// called while the environment is changed.
LogWriter::Output log_output();

}  // namespace orbwatch::app
