import { Page } from './page/page';

void new Page(document.getElementById('page')!).start();
