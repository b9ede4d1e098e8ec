# Sourced: sizes of partitions in MiB. Updates cannot change those of a slot, so they have room for later versions;
# the data partition grows on the device.
# shellcheck shell=bash disable=SC2034
# SPDX-License-Identifier: Apache-2.0
efi_size=128 root_size=768 data_size=128
