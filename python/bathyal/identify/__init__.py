# SPDX-License-Identifier: BSD-3-Clause
"""Identification of an arm: touches from files, the job, its report."""
