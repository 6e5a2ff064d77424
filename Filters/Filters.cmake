# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes)
list(APPEND sources)
list(APPEND private_headers)
