// SPDX-License-Identifier: Apache-2.0
/// Shared object that is unrelated to cameras.
extern "C" int orbwatch_something_else() { return 0; }
