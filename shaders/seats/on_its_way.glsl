// SPDX-License-Identifier: Apache-2.0

/// Whether somebody walks to its seat or away from it, or asks to come in.
bool isOnItsWay(uint mode) { return mode == SITTER_ASKS || mode == SITTER_ENTERS || mode == SITTER_LEAVES; }
