// SPDX-License-Identifier: Apache-2.0
// Nothing: it is compiled for the precompiled headers that the tests share.
