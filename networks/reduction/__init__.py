"""From flat equations to a DAE of index 1: checked, differentiated, solved where possible."""
