# SPDX-License-Identifier: MIT
"""What rules look at in a drawing: columns of its linework, and what its file says."""
