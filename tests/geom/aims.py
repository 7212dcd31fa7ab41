# SPDX-License-Identifier: MIT
"""How ends head for things: as the shipped profiles have it, and without any direction."""

import numpy as np

from foparq.geom.ends import Aim

AIM = Aim(np.radians(60), np.radians(15), 3.0)
#: whatever is near is missed, and every stub is an overshoot
ANYWHERE = Aim(np.pi, 0.0, 0.0)
