"""From a tree of components to one set of variables and families of equations."""
