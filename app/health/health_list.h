/* The one list of the appliance's health figures. Read by C++ (the struct, the Modbus rows, the
 * manual) and by the DDS IDL compiler, so it holds nothing but this macro.
 *
 * X(name, unit, scale, minimum, maximum, description)
 * name: snake_case; the struct member, the DDS member and the Modbus name.
 * scale: Modbus sends value / scale as a 32-bit integer. minimum, maximum: in the unit; what is
 * read outside of them is not believed. */
#ifndef ORBWATCH_APP_HEALTH_HEALTH_LIST_H
#define ORBWATCH_APP_HEALTH_HEALTH_LIST_H

#define ORBWATCH_HEALTH(X)                                                                        \
  X(board_temperature, "degC", 0.1, -100, 200, "Hottest thermal zone of the board")               \
  X(throttling, "", 1, 0, 255,                                                                    \
    "Bits: 0 under-voltage, 1 capped, 2 throttled, 3 hot; 4 to 7 the same since power-on")        \
  X(processor_load, "%", 0.1, 0, 100, "Share of all processors' time since the last sample")      \
  X(processor_frequency, "MHz", 1, 0, 100000, "Present clock of the fastest processor")           \
  X(memory_available, "MiB", 1, 0, 1e9, "Memory that programs can get without swapping")          \
  X(disk_free, "MiB", 1, 0, 2e9, "Free for orbwatch on the disk that it records to")              \
  X(disk_free_share, "%", 0.1, 0, 100, "The same, of the file system's size")                     \
  X(clock_synchronised, "", 1, 0, 1, "1: the system's clock follows a time server")               \
  X(clock_estimated_error, "ms", 0.001, 0, 1e6, "Error of the system's clock as its server says") \
  X(clock_maximum_error, "ms", 0.001, 0, 1e6, "Bound of that error; grows until the next answer") \
  X(resident_memory, "MiB", 0.1, 0, 1e8, "Memory that orbwatch itself holds")                     \
  X(open_descriptors, "", 1, 0, 1e9, "Files, devices and connections that orbwatch has open")

#endif
