# SPDX-License-Identifier: Apache-2.0
"""Modules with the calls of other packages, on top of trysquare: `map_metrics`."""
