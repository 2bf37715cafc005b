# SPDX-License-Identifier: BSD-3-Clause
"""One module a file format; `bathyal.clouds` and `bathyal.meshes` choose among them by suffix."""
