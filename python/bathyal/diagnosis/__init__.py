# SPDX-License-Identifier: BSD-3-Clause
"""Diagnosis of an arm: the job, its files, its report."""
