# SPDX-License-Identifier: MIT
"""The contract, typed: product specifications and delivery manifests."""
