"""Language data: grammars of questions and answers, lexicons, tables of words."""
