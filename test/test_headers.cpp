// SPDX-License-Identifier: BSD-3-Clause
// Holds nothing: the target that precompiles the headers of the tests needs a source.
