/// Small tissues and readings, and what is believed of them.
#pragma once

#include "palpation/belief/belief.h"
#include "readings/tissue.h"
