// SPDX-License-Identifier: Apache-2.0
// Alarms that need a person, and how urgent they are.

// Numbers of proc/signals/alarm.h, which stay the same.
const kNormal = 0, kSuppressed = 6;
const kAlarmLevels = [1, 4, 5], kWarningLevels = [2, 3];

// 2: alarm, 1: warning, 0: neither.
export function severity({ level, announced }) {
  const isAmong = (levels) => levels.includes(level) || levels.includes(announced);
  return isAmong(kAlarmLevels) ? 2 : isAmong(kWarningLevels) ? 1 : 0;
}

// Alarms that are active or not acknowledged, the worst first.
export function raisedAlarms(alarms) {
  return alarms.filter(({ state }) => state !== kNormal && state !== kSuppressed)
    .sort((one, other) => severity(other) - severity(one));
}
